#pragma once

#include "kernel/model/segmentation.h"
#include "kernel/segment/detail/edge_index.h"
#include "kernel/segment/detail/natural_chains.h"
#include "kernel/segment/detail/section.h"
#include "kernel/segment/segment.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace oriel::detail {

/// What one part that was taken off has changed in the body.
struct Change {
  /// The points of everything that has changed; an edge without any of them is as it was.
  std::vector<int> points;
  /// The points of the part.
  std::vector<int> part;
  /// The edges around its cap, if it has a single one with a single outline that covers nothing;
  /// else none.
  std::vector<std::pair<int, int>> rim;
  /// The cut follows existing edges: nothing was split.
  bool is_natural = false;
  /// Edges that the body may have since.
  std::vector<std::pair<int, int>> new_edges;
  /// Facets were covered, so that more edges than those bound other facets since.
  bool has_covered = false;
};

/// The sections of a body at all its split planes, looked at from both sides, as they are after
/// every cut. Sections that a cut has not touched are kept; so is the knowledge that there is
/// nothing to cut at a plane, as long as what was changed there is too small to matter
/// (docs/segmentation.md).
class Slots {
 public:
  /// A split plane seen from one side.
  struct Slot {
    std::size_t entry;  ///< of its plane in planes_
    bool is_stale = true;
    /// Nothing can be cut here. Of material and of air, the area by which the smallest region is
    /// too large.
    bool is_idle = false;
    std::array<double, 2> margins{};
    /// No region's outline follows edges, so none becomes natural by losing a loop in it.
    bool is_fenced = false;
    /// Some loops have gone; nothing else has changed.
    bool is_to_prune = false;
    Section section{};  ///< kept if there is something to cut
  };

  /// `free_side`: the ground, in which outlines are free. `own_planes`: no split planes of the
  /// body.
  Slots(const Boundary& body, const SegmentOptions& options, Side free_side,
        const std::vector<int>& own_planes, SegmentationStats& stats, std::int64_t& work);

  /// Tells that the body has changed in this way and no other.
  void changed(std::vector<Change> changes);
  /// Looks again at what has changed. With `natural_only` slots in which no natural region can be
  /// are put off: they hold nothing to cut until they are asked for without.
  void refresh(bool natural_only);

  /// The slots with something to cut, ascending.
  [[nodiscard]] const std::set<std::size_t>& promising() const { return promising_; }
  [[nodiscard]] const Slot& operator[](std::size_t i) const { return slots_[i]; }

 private:
  /// What a change means to the planes of one normal class: the ranks of its points, and of those
  /// of the part.
  struct Reach {
    int normal_class;
    int low, high;
    int part_low, part_high;
  };

  void find_natural();
  void put_off();
  void sweep_classes();
  void sweep_class(int normal_class, std::size_t first, std::size_t last);
  void let_rest(Slot& slot, double area_m2);
  void count_tests(const Slot& slot);
  void refresh(Slot& slot);
  bool prune(Slot& slot);
  [[nodiscard]] bool judge(Slot& slot, const Section& section) const;
  void apply(const Change& change);
  void touch(std::size_t number, const Change& change, const Reach& reach, const Box& part);
  [[nodiscard]] bool stays_idle(Slot& slot, const Change& change, const Reach& reach,
                                const Box& part) const;
  [[nodiscard]] bool loses_loops_only(const Slot& slot, const Change& change,
                                      const Reach& reach) const;

  const Boundary& body_;
  World& world_;
  SectionOptions section_options_;
  SegmentationStats& stats_;
  std::int64_t& work_;
  std::vector<int> planes_;  ///< the split planes, ascending
  EdgeIndex edges_;
  std::vector<Slot> slots_;           ///< of each plane in front, then behind
  std::vector<std::size_t> to_do_;    ///< slots to look at again
  std::vector<std::size_t> put_off_;  ///< those of them in which nothing natural can be
  NaturalChains chains_;
  std::set<std::size_t> promising_;  ///< slots with something to cut
  Section fresh_;                    ///< room for the section at hand
};

}  // namespace oriel::detail
