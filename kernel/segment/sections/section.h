#pragma once

#include "kernel/segment/boundary/boundary.h"

#include <array>
#include <span>
#include <vector>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

/// A loop of a section: Section::loops.
using SectionLoopId = Id<struct SectionLoopTag>;
/// A region of a section: Section::regions.
using RegionId = Id<struct RegionTag>;

/// Where an edge of a body crosses a section plane.
struct Crossing {
  EdgeId edge = {};      ///< the half-edge that leads from the looked-at side to the other
  Vec3 at;               ///< on the plane
  CrossingId next = {};  ///< the crossing at the other end of the chord in the facet of `edge`
  SectionLoopId loop = {};
};

/// A closed chain of chords, counter-clockwise about the direction looked to if it encloses
/// material.
struct SectionLoop {
  CrossingId first = {};
  double area = 0;  ///< > 0: material inside, < 0: air inside
};

/// A connected region of the section: what is in front of the plane of a feature that is cut there.
/// Of material it is the contact of a protrusion, of air the cap of a hole.
struct Region {
  bool is_material = true;
  boost::container::small_vector<SectionLoopId, 2>
      loops;  ///< the one around it first, then those it surrounds
  /// Its area, and without what coplanar facets of the opposite side cover: the new area of the
  /// cut.
  double area = 0;
  double new_area = 0;
  /// Those facets.
  std::vector<BodyFacetId> covered = {};
  /// It is natural or smaller than the old area, and no sliver: a feature may begin here.
  bool is_candidate = false;
  /// Every chord follows existing edges (or lies in the ground): the cut splits no facet, but for
  /// the ground and facets that it goes through at a neck.
  bool is_natural = false;
  /// The same of the loop around it alone.
  bool has_natural_outline = false;
  /// It is natural, and chords of it go through a neck.
  bool has_neck = false;
};

/// The section of a body at a plane ± 0: `direction` +1 looks just in front of the plane (as its
/// class has it), -1 just behind, and points on the plane count as on the other side. So every
/// degeneracy vanishes: the loops are clean, and what lies in the plane itself belongs to the other
/// side. Paper, section 4 a and b.
struct Section {
  int plane = -1;
  int direction = 1;
  IndexedVector<CrossingId, Crossing> crossings = {};
  IndexedVector<SectionLoopId, SectionLoop> loops = {};
  IndexedVector<RegionId, Region> regions = {};
  /// The area of the body's facets on the split side of air and of material: the old area of a cut.
  std::array<double, 2> old_areas = {};
  bool is_by_loop = false;  ///< crossings stand loop by loop, in their order

  /// The side that looks to where the section looks.
  [[nodiscard]] PlaneSide looking() const { return 2 * plane + (direction > 0 ? 0 : 1); }
  [[nodiscard]] double old_area(const Region& region) const {
    return old_areas[region.is_material ? 1 : 0];
  }
  /// The side of the split plane for features of a region: a protrusion's is the side that looks
  /// the same way, a hole's the opposite one.
  [[nodiscard]] PlaneSide split_side(const Region& region) const {
    return region.is_material ? looking() : looking() ^ 1;
  }
};

/// A loop of a section as points.
Outline outline_of(const Section& section, SectionLoopId loop);

/// What a section needs to know beside the body.
struct SectionOptions {
  /// Chords in facets of this side are as good as edges (-1: none): the ground.
  PlaneSide free_side = -1;
  /// A region thinner than this is none.
  double weld_m = 0;
  /// Chords through a neck of a facet are as good as edges: both ends are corners of the facet at
  /// which an edge of it goes on along the chord's line, as those of a floor do where it runs on
  /// into a doorway.
  bool are_necks_free = false;
  /// Regions without old area are judged, too: what they cover is taken off.
  bool has_all_regions = false;
};

/// Makes the section of `section.plane` towards `section.direction`, whatever was in `section`
/// before. `edges` holds at least one half-edge of every edge that crosses the plane; dead ones and
/// others do no harm. The air around the body has no region. A body whose crossings do not
/// alternate along a facet (possible only where vertices are rounded) gives no loops
/// and no regions.
void section_at(const Boundary& body, Section& section, std::span<const EdgeId> edges,
                const SectionOptions& options);

/// Brings a section up to date after natural cuts whose parts it met in whole loops or not at all:
/// loops of dead edges go, and with them the regions inside. False if a loop is dead in part only:
/// then the section is to be made anew.
bool prune_section(const Boundary& body, Section& section, const SectionOptions& options);

}  // namespace oriel::detail
