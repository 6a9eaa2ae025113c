#pragma once

#include "kernel/segment/cuts/corner_holes.h"
#include "kernel/segment/cuts/cut_candidates.h"
#include "kernel/segment/cuts/lump.h"
#include "kernel/segment/cuts/pockets.h"
#include "kernel/segment/segment.h"
#include "model/segmentation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace oriel::detail {

/// What the planes of one cut split off in one step: an n-ary node of the tree. Either lumps in
/// front of one plane, or patches that several planes cap.
struct CutChoice {
  bool is_hole = false;
  bool is_natural = false;
  bool has_neck = false;  ///< the cut goes through a neck of a facet
  double value = 0;       ///< the key the order sorts by, of the best part
  double quality = 0;     ///< new area / old area of the best part
  double volume = 0;      ///< of all parts
  std::vector<PlaneSide> sides;
  double old_area = 0;

  const Section* section = nullptr;  ///< for one plane
  std::vector<Lump> lumps;
  const Pockets* pockets = nullptr;  ///< that the lumps may be
  std::vector<Patch> patches;        ///< for several
  /// The body that the patches are of, if planes were imprinted for them.
  std::shared_ptr<const Boundary> imprinted;
};

/// Planes and kind of a cut.
struct CutKey {
  std::vector<PlaneSide> sides;
  bool is_hole = false;
  friend auto operator<=>(const CutKey&, const CutKey&) = default;
};

/// Finds the best cut of one body, step after step.
class Chooser {
 public:
  /// `free_side`: the ground, in which outlines are free. `own_planes`: no split planes of this
  /// body.
  Chooser(const Boundary& body, const SegmentOptions& options, PlaneSide free_side,
          std::vector<int> own_planes, SegmentationStats& stats);

  /// Returns the best cut by the order that is not `banned`, or nothing: the body is a leaf, or the
  /// world's work is used up.
  std::optional<CutChoice> next(const std::set<CutKey>& banned);

  /// Tells that the body has changed in this way and no other.
  void changed(std::span<const RestChange> changes) {
    candidates_.invalidate(changes);
    pockets_.changed(changes);
  }

 private:
  /// The passes differ in which regions they take, and by what they sort them.
  enum class Pass { natural, wide_natural, strict };
  static constexpr std::size_t kPasses = 3;
  /// The least key of the regions of a side of a plane in a pass, and at which version.
  struct Least {
    int version = -1;
    double key = 0;
  };
  /// A region as a candidate of the pass at hand.
  struct RegionCandidate {
    std::size_t number = 0;  ///< of its section in candidates_
    const Section* section = nullptr;
    RegionId region = {};
    int lump = -1;  ///< in lumps_ once the flood has found it
    double key = 0;
  };
  [[nodiscard]] const Lump& lump_of(const RegionCandidate& candidate) const {
    return lumps_[static_cast<std::size_t>(candidate.lump)];
  }
  std::optional<CutChoice> natural_next();
  std::optional<CutChoice> paper_next();
  std::optional<CutChoice> best_section_cut(Pass pass);
  [[nodiscard]] std::optional<double> key_of(Pass pass, const Region& region, double new_area,
                                             double old_area) const;
  [[nodiscard]] double least_key(std::size_t number, Pass pass);
  void wait_for_sections(Pass pass);
  void take_candidates(std::vector<RegionCandidate>& candidates, Pass pass, double most);
  template <class Visit>
  void for_each_candidate(const Section& section, Pass pass, Visit visit) const;
  void check_leaders(std::vector<RegionCandidate>& candidates, Pass pass);
  bool check(RegionCandidate& candidate, Pass pass, bool is_alone);
  [[nodiscard]] bool is_larger_half(const Lump& lump, const Section& section) const;
  Lump lump_at(const RegionCandidate& candidate, bool is_alone);
  Lump lump_of(PocketId pocket, const RegionCandidate& candidate);
  Lump flood(const RegionCandidate& candidate);
  std::optional<CutChoice> best_patch_cut(std::span<const Patch> patches, int min_order,
                                          int max_order);
  CutChoice choice_of(std::span<const RegionCandidate> candidates, std::size_t leader) const;
  CutChoice choice_of(std::span<const Patch* const> patches, const Patch& first) const;
  [[nodiscard]] bool is_better(const CutChoice& p, const CutChoice& q) const;
  [[nodiscard]] bool is_banned(const Section& section, const Region& region) const {
    return !banned_->empty() &&
           banned_->contains({{section.split_side(region)}, !region.is_material});
  }
  [[nodiscard]] bool is_banned(const Patch& patch) const {
    return !banned_->empty() && banned_->contains({patch.sides(), patch.is_hole});
  }
  std::vector<Patch> patches(bool is_hole, double most);
  std::optional<CutChoice> part_on_steps(const CutChoice& choice);
  std::optional<CutChoice> corner_cut(std::span<const Patch> natural);
  std::optional<CutChoice> first_of_least_order(std::span<const Patch> patches);
  [[nodiscard]] bool is_same_value(double p, double q) const {
    return std::abs(p - q) <= tie_ * std::max(p, q);
  }
  [[nodiscard]] double limit() const { return 1 - options_.tolerances.value_rel; }

  const Boundary& body_;
  World& world_;
  const SegmentOptions& options_;
  PlaneSide free_side_;
  std::vector<int> own_planes_;
  SegmentationStats& stats_;
  double tie_;  ///< values that are closer, relatively, are the same
  CutCandidates candidates_;
  const std::set<CutKey>* banned_ = nullptr;
  Pockets pockets_;
  std::array<std::vector<Least>, kPasses> leasts_;  ///< by section of candidates_
  // Found in the pass at hand.
  /// Sections by the least key of what was not taken of them, a heap.
  std::vector<std::pair<double, std::size_t>> waiting_;
  std::vector<Lump> lumps_;
  const Section* flooded_ = nullptr;  ///< the one that finder_ is for
  std::optional<LumpFinder> finder_;
  IndexedVector<PocketKindId, int>
      lump_of_kind_;  ///< the first lump of each kind of pockets; -1: none yet
};

}  // namespace oriel::detail
