#pragma once

#include "kernel/model/segmentation.h"
#include "kernel/segment/cuts/slot_set.h"
#include "kernel/segment/planes/margins.h"
#include "kernel/segment/sections/edge_index.h"
#include "kernel/segment/sections/natural_chains.h"
#include "kernel/segment/sections/section.h"
#include "kernel/segment/segment.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

namespace oriel::detail {

/// What one part that was taken off has changed in the body.
struct Change {
  /// The points of everything that has changed; an edge without any of them is as it was. Sorted,
  /// each once.
  std::vector<int> points;
  /// The points of the part, likewise. None: the same points.
  std::vector<int> part;
  /// The edges around its cap, if it has a single one with a single outline that covers nothing;
  /// else none.
  std::vector<std::pair<int, int>> rim;
  /// The cut follows existing edges: nothing was split.
  bool is_natural = false;
  /// The rim was a hole of one facet, and is gone without a trace.
  bool is_ring = false;
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
    std::size_t entry = 0;       ///< of its plane in planes_
    Section* section = nullptr;  ///< as it was last kept, in sections_; null: none ever was
    int looks = 0;               ///< how often its section was looked at again
    /// unclear_changes_ as it was when its section was made, or swept over.
    int unclear_changes = -1;
    int direction = 1;  ///< as that of a Section
    bool is_stale = true;
    /// Nothing can be cut here; margins_ has the area by which the smallest region is too large.
    bool is_idle = false;
    /// No region's outline follows edges, so none becomes natural by losing a loop in it.
    bool is_fenced = false;
    /// Some loops have gone; nothing else has changed.
    bool is_to_prune = false;

    [[nodiscard]] bool has_regions() const {
      return section != nullptr && !section->regions.empty();
    }
  };

  /// `free_side`: the ground, in which outlines are free. `own_planes`: no split planes of the
  /// body.
  Slots(const Boundary& body, const SegmentOptions& options, Side free_side,
        const std::vector<int>& own_planes, SegmentationStats& stats, std::int64_t& work);

  /// Tells that the body has changed in this way and no other.
  void changed(const std::vector<Change>& changes);
  /// Looks again at what has changed. With `natural_only` slots in which no natural region can be
  /// are put off: they hold nothing to cut until they are asked for without.
  void refresh(bool natural_only);

  /// The slots with something to cut.
  [[nodiscard]] const SlotSet& promising() const { return promising_; }
  [[nodiscard]] std::size_t size() const { return slots_.size(); }
  [[nodiscard]] const Slot& operator[](std::size_t i) const { return slots_[i]; }

 private:
  /// The split planes of one normal class: planes_[first…last).
  struct Class {
    int number;
    std::size_t first, last;
  };
  /// What a change means to the planes of one class: the ranks of its points, of those of the part,
  /// and of those around its cap.
  struct Reach {
    int low, high;
    int part_low, part_high;
    int rim_low, rim_high, rim_start;
    bool is_natural, is_ring;
    /// There is a cap whose outline goes up once and down once: a plane between its ends that meets
    /// no point of it is met by it twice.
    bool is_rim_convex;
    Few<int, 8> hits;  ///< ranks of planes that points lie on, ascending
    /// A ring that goes up once and down once was filled.
    [[nodiscard]] bool is_plain() const { return is_natural && is_ring && is_rim_convex; }
    friend bool operator==(const Reach&, const Reach&) = default;
  };
  /// Changes that mean the same to a class. No plane of it cuts a larger area out of all their
  /// parts.
  struct Run {
    const Change* change = nullptr;  ///< the first of them
    Reach reach;
    double area = 0;
    bool is_merged = false;  ///< into another one
  };
  [[nodiscard]] Side looking(const Slot& slot) const {
    return 2 * planes_[slot.entry] + (slot.direction > 0 ? 0 : 1);
  }
  Section& section_of(Slot& slot);
  static void clear_regions(Slot& slot) {
    if (slot.section != nullptr) slot.section->regions.clear();
  }
  void find_natural();
  void put_off();
  void sweep_classes();
  void sweep_class(const Class& c);
  void swept(std::size_t number, double area_m2);
  void look_across_gap(std::size_t number);
  void let_rest(std::size_t number, double margin_m2);
  /// As Section::old_areas.
  void count_tests(const std::array<double, 2>& old_areas);
  void refresh(std::size_t number);
  bool prune(std::size_t number);
  [[nodiscard]] bool judge(std::size_t number, const Section& section);
  /// A change as all classes see it.
  struct Seen {
    const Change* change;
    Box part;
    bool is_exact_ring;  ///< and all its points are meetings
  };
  [[nodiscard]] Seen look_at(const Change& change) const;
  void apply(std::size_t k, std::span<const Seen> changes);
  /// The first plane of the class at hand with this rank or more.
  [[nodiscard]] std::size_t first_at(const Class& c, int rank) const {
    return c.first + ranks_->before(rank);
  }
  void find_runs(const Class& c, std::span<const Seen> changes);
  void merge_runs();
  static void find_reach(std::span<const int> rank, const Seen& seen, Reach& reach);
  [[nodiscard]] static bool mean_the_same(std::span<const int> rank, const Seen& p, const Seen& q);
  void touch_all(const Class& c, const Run& run);
  void touch_along(const Class& c, const Run& run);
  void touch_plane(std::size_t entry, const Run& run);
  void touch(std::size_t number, const Run& run);
  void make_stale(std::size_t number);
  bool stays_idle(std::size_t number, const Run& run);
  bool stays_idle_beside(std::size_t number, const Run& run);
  [[nodiscard]] bool loses_loops_only(const Slot& slot, const Reach& reach) const;

  const Boundary& body_;
  World& world_;
  SectionOptions section_options_;
  SegmentationStats& stats_;
  std::int64_t& work_;
  std::vector<int> planes_;  ///< the split planes, ascending
  EdgeIndex edges_;
  std::vector<Class> classes_;
  std::vector<Slot> slots_;       ///< of each plane in front, then behind
  std::deque<Section> sections_;  ///< of slots
  /// How many changes there were that filled no plain ring: what is clear has met none of them.
  int unclear_changes_ = 0;
  Margins margins_;                   ///< of idle slots
  SlotSet lively_;                    ///< slots with a section that is kept
  std::vector<std::size_t> to_do_;    ///< slots to look at again
  std::vector<std::size_t> put_off_;  ///< those of them in which nothing natural can be
  NaturalChains chains_;
  SlotSet promising_;                  ///< slots with something to cut
  Section fresh_;                      ///< room for the section at hand
  std::vector<Run> room_;              ///< for runs of the class at hand
  std::span<Run> runs_;                ///< those in use
  const PlaneRanks* ranks_ = nullptr;  ///< of that class
};

}  // namespace oriel::detail
