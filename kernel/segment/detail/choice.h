#pragma once

#include "kernel/model/segmentation.h"
#include "kernel/segment/detail/corner_holes.h"
#include "kernel/segment/detail/edge_index.h"
#include "kernel/segment/detail/lump.h"
#include "kernel/segment/detail/section.h"
#include "kernel/segment/segment.h"

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace oriel::detail {

/// What the planes of one cut split off in one step: an n-ary node of the tree. Either lumps in
/// front of one plane, or patches that several planes cap.
struct Choice {
  bool is_hole = false;
  bool is_natural = false;
  double value = 0;    ///< the key the order sorts by, of the best part
  double quality = 0;  ///< new area / old area of the best part
  double volume = 0;   ///< of all parts
  std::vector<Side> sides;
  double old_area = 0;

  const Section* section = nullptr;  ///< for one plane
  std::vector<Lump> lumps;
  std::vector<Patch> patches;  ///< for several
  /// The body that the patches are of, if planes were imprinted for them.
  std::shared_ptr<const Boundary> imprinted;
};

/// Planes and kind of a cut.
struct CutKey {
  std::vector<Side> sides;
  bool is_hole = false;
  friend auto operator<=>(const CutKey&, const CutKey&) = default;
};

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
};

/// Finds the best cut of one body, step after step. Sections of planes that a cut has not touched
/// are kept; so is the knowledge that there is nothing to cut at a plane, as long as what was
/// changed there is too small to matter (docs/segmentation.md).
class Chooser {
 public:
  /// `free_side`: the ground, in which outlines are free. `own_planes`: no split planes of this
  /// body.
  Chooser(const Boundary& body, const SegmentOptions& options, Side free_side,
          std::vector<int> own_planes, SegmentationStats& stats, std::int64_t& work);

  /// The best cut by the order that is not `banned`, or nothing: the body is a leaf.
  std::optional<Choice> next(const std::set<CutKey>& banned);

  /// Tells that the body has changed in this way and no other.
  void changed(std::vector<Change> changes);

 private:
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
  /// What a change means to the planes of one normal class: the ranks of its points, and of those
  /// of the part.
  struct Reach {
    int normal_class;
    int low, high;
    int part_low, part_high;
  };
  /// A region as a candidate of the pass at hand.
  struct Candidate {
    Slot* slot = nullptr;
    int region = -1;
    int lump = -1;  ///< in lumps_ once the flood has found it
    double key = 0;
  };
  [[nodiscard]] const Lump& lump_of(const Candidate& candidate) const {
    return lumps_[static_cast<std::size_t>(candidate.lump)];
  }
  using Key = std::optional<double> (*)(const Region&, double new_area, double old_area,
                                        double limit);

  void sweep_classes();
  void sweep_class(int normal_class, std::size_t first, std::size_t last);
  void let_rest(Slot& slot, double area_m2);
  void count_tests(const Slot& slot);
  void refresh();
  std::optional<Choice> natural_next();
  std::optional<Choice> paper_next();
  std::optional<Choice> best_section_cut(Key key, const std::vector<Patch>& rivals);
  void refresh(Slot& slot);
  bool prune(Slot& slot);
  [[nodiscard]] bool judge(Slot& slot, const Section& section) const;
  void apply(const Change& change);
  void touch(std::size_t number, const Change& change, const Reach& reach, const Box& part);
  [[nodiscard]] bool stays_idle(Slot& slot, const Change& change, const Reach& reach,
                                const Box& part) const;
  [[nodiscard]] bool loses_loops_only(const Slot& slot, const Change& change,
                                      const Reach& reach) const;
  void check_leaders(std::vector<Candidate>& candidates, Key key);
  bool check(Candidate& candidate, Key key, LumpFinder& finder);
  std::optional<Choice> best_patch_cut(std::vector<Patch> patches, int min_order, int max_order);
  Choice choice_of(const std::vector<Candidate>& candidates, std::size_t leader) const;
  Choice choice_of(const std::vector<Patch>& patches, std::size_t leader) const;
  [[nodiscard]] bool is_better(const Choice& p, const Choice& q) const;
  [[nodiscard]] bool is_banned(const Section& section, const Region& region) const {
    return !banned_->empty() &&
           banned_->contains({{section.split_side(region)}, !region.is_material});
  }
  [[nodiscard]] bool is_banned(const Patch& patch) const {
    return !banned_->empty() && banned_->contains({patch.sides(), patch.is_hole});
  }
  std::vector<Patch> patches(bool is_hole);
  std::optional<Choice> corner_cut(const std::vector<Patch>& natural);
  std::optional<Choice> first_of_least_order(const std::vector<Patch>& patches);
  [[nodiscard]] double limit() const { return 1 - options_.tolerances.value_rel; }

  const Boundary& body_;
  World& world_;
  const SegmentOptions& options_;
  Side free_side_;
  std::vector<int> own_planes_;
  SegmentationStats& stats_;
  std::int64_t& work_;
  std::vector<int> planes_;  ///< the split planes, ascending
  EdgeIndex edges_;
  const std::set<CutKey>* banned_ = nullptr;
  std::vector<Slot> slots_;          ///< of each plane in front, then behind
  std::vector<std::size_t> to_do_;   ///< slots to look at again
  std::set<std::size_t> promising_;  ///< slots with something to cut
  Section fresh_;                    ///< room for the section at hand
  std::vector<Lump> lumps_;          ///< found in the pass at hand
};

}  // namespace oriel::detail
