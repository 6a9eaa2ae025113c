#pragma once

#include "kernel/segment/sections/section.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

/// One of the pockets that were found in a body.
using PocketId = Id<struct PocketTag>;

/// A connected piece of material (or air) in front of a section plane: what a cut there would split
/// off.
struct Lump {
  boost::container::small_vector<RegionId, 2>
      regions;  ///< of the section, ascending: all its contacts with the plane
  double new_area = 0;
  double volume = 0;
  double value = 0;      ///< the key that the order sorts it by
  PocketId pocket = {};  ///< if it is one that was looked for
  /// Its value is like that of no other lump of its section: it is congruent to none.
  bool is_alone = false;
  /// Of air: it does not run out into the open. Material is always finite.
  bool is_finite = true;
  /// Its pieces of facets have positive area. A hole that pokes out of its facet (bad input) makes
  /// pieces turned inside out, and no cut there separates anything.
  bool is_sound = true;
  /// Its wall holds a reflex edge of the body, so it lies in two or more planes.
  bool has_bend = false;
};

/// Finds lumps by flooding the surface from a region, without cutting anything: the cost is the
/// lump's size.
class LumpFinder {
 public:
  /// Only one finder at a time may be in use.
  LumpFinder(const Boundary& body, const Section& section);

  /// The lump in front of region `region`. One that is not finite or not sound is given up as soon
  /// as that is seen: the rest of it is not looked at.
  [[nodiscard]] Lump find(RegionId region);
  /// The half-edges that the last lump was found by.
  [[nodiscard]] std::int64_t steps() const { return steps_; }

 private:
  void push(EdgeId e);
  void visit(EdgeId e);
  void reach(CrossingId crossing);
  [[nodiscard]] bool has_sound_pieces(CrossingId crossing) const;
  void add_segment(EdgeId e, Vec3 from, Vec3 to);
  void tie_enclosed_loops();
  void tie_loop_to_piece(BodyFacetId facet, LoopId loop);
  [[nodiscard]] bool is_wholly_up(LoopId loop) const;
  template <class Visit>
  bool visit_piece(CrossingId crossing, Visit visit) const;
  template <class Visit>
  bool visit_lower_piece(CrossingId crossing, Visit visit) const;
  [[nodiscard]] bool is_up(PointId point) const {
    return (ranks_[point] - plane_rank_) * section_.direction > 0;
  }
  /// Invalid: the section does not cross the edge, of which an earlier one may have left a number.
  [[nodiscard]] CrossingId crossing_of(EdgeId e) const {
    const CrossingId c = scratch_.crossing_of_edge[e];
    const bool is_here = section_.crossings.contains(c) && section_.crossings[c].edge == e;
    return is_here ? c : CrossingId{};
  }
  [[nodiscard]] bool is_reached(EdgeId e) const { return scratch_.flooded_edges.contains(e); }

  const Boundary& body_;
  const Section& section_;
  PointRanks ranks_;
  int plane_rank_;
  Scratch& scratch_;
  IndexedVector<CrossingId, CrossingId>
      next_in_facet_;  ///< of crossings where a chord begins: another in its facet
  IndexedVector<CrossingId, CrossingId>
      previous_;  ///< where the chord that ends at a crossing begins
  /// For each loop the region of air and of material that it bounds.
  IndexedVector<SectionLoopId, std::array<RegionId, 2>> region_of_;

  // The flood at hand.
  bool is_material_ = true;
  int stamp_ = 0;
  std::int64_t steps_ = 0;
  IndexedVector<CrossingId, int> crossing_stamp_;
  std::vector<EdgeId> stack_;
  std::vector<BodyFacetId> facets_;
  double patch_volume_ = 0;
  Lump lump_;
};

}  // namespace oriel::detail
