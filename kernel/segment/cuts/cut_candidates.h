#pragma once

#include "kernel/segment/sections/edge_index.h"
#include "kernel/segment/sections/natural_chains.h"
#include "kernel/segment/sections/section.h"
#include "kernel/segment/segment.h"
#include "model/segmentation.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

namespace oriel::detail {

/// What one part that was taken off has changed in the rest.
struct RestChange {
  /// The points of everything that has changed; an edge without any of them is unchanged. Sorted,
  /// each once.
  std::vector<PointId> points = {};
  /// The edges around the part's cap, if it has a single one with a single outline that covers
  /// nothing; else none.
  std::vector<std::pair<PointId, PointId>> rim = {};
  /// The cut follows existing edges: nothing was split.
  bool is_natural = false;
  /// Edges that the body may have since.
  std::vector<std::pair<PointId, PointId>> new_edges = {};
  /// Facets were covered, so that more edges than those bound other facets since.
  bool has_covered = false;
};

/// A split plane seen from one side.
struct CutCandidate {
  enum class State : std::uint8_t {
    stale,   ///< unknown: a cut has touched it since its section was made, or none ever was
    shrunk,  ///< as active, but loops of its section have gone with parts; nothing else has changed
    cached,  ///< nothing can be cut here, as the section has shown
    active,  ///< the section is up to date
  };

  std::size_t entry = 0;  ///< of its plane among the split planes
  int direction = 1;      ///< as that of a Section
  State state = State::stale;
  int version = 0;             ///< counts how often it was brought up to date
  Section* section = nullptr;  ///< null: none was kept ever

  [[nodiscard]] bool has_regions() const { return section != nullptr && !section->regions.empty(); }
};

/// Where the cuts by one plane may begin: for each side of each split plane of a body the section
/// just beyond it, kept as long as no cut has touched it.
class CutCandidates {
 public:
  /// `free_side`: the ground, in which outlines are free. `own_planes`: no split planes of the
  /// body.
  CutCandidates(const Boundary& body, const SegmentOptions& options, PlaneSide free_side,
                std::span<const int> own_planes, SegmentationStats& stats);

  /// Tells that the body has changed in this way and in no other since the last call.
  void invalidate(std::span<const RestChange> changes);
  /// Brings all candidates up to date, as long as there is work left. With `natural_only` those in
  /// which no natural region can be stay stale, without regions.
  void refresh(bool natural_only);

  [[nodiscard]] std::size_t size() const { return candidates_.size(); }
  [[nodiscard]] const CutCandidate& operator[](std::size_t i) const { return candidates_[i]; }

 private:
  /// The split planes of one normal class: planes_[first…last).
  struct PlanesOfClass {
    int number;
    std::size_t first, last;
  };
  void invalidate(std::size_t k, const RestChange& change);
  void make_section(CutCandidate& candidate);
  [[nodiscard]] bool prune(CutCandidate& candidate);
  Section& section_of(CutCandidate& candidate);

  const Boundary& body_;
  World& world_;
  SectionOptions section_options_;
  SegmentationStats& stats_;
  std::vector<int> planes_;  ///< the split planes, ascending
  std::vector<PlanesOfClass> classes_;
  EdgeIndex edges_;
  NaturalChains chains_;
  std::vector<CutCandidate> candidates_;  ///< of each plane in front, then behind
  std::deque<Section> sections_;          ///< of candidates
  Section fresh_;                         ///< room for the section at hand
};

}  // namespace oriel::detail
