#pragma once

#include "generalise/invariants/invariants.h"
#include "kernel/base/issue.h"
#include "kernel/base/work.h"
#include "kernel/segment/segment.h"
#include "model/building.h"
#include "model/description/feature_table.h"
#include "model/interpretation.h"
#include "model/labelled_building.h"
#include "model/segmentation.h"
#include "model/solid.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

namespace detail {
class BuildingCells;
}

/// Whether a solid is fit to be written.
enum class Fitness {
  unfit,
  as_it_came,  ///< not valid, but the building was not valid either
  valid
};

/// Says how fit a solid is. That takes longer than cutting, and whoever writes checks anyway.
class SolidJudge {
 public:
  virtual ~SolidJudge() = default;

  virtual Fitness fitness_of(const Solid& solid) = 0;
};

/// How many corners the facets of a solid have: what work on it is counted by.
std::int64_t corners_of(const Solid& solid);

/// Why a feature stays for which there was no work left (E502).
inline constexpr const char* kNoWorkLeft = "the work budget is used up";

/// A building that is redrawn, what must hold of what is drawn, and what that may take. Refers to
/// all that it is made of; all of one building, made with the same options. What is tried with it
/// changes nothing in it but the work that is done, and what was found on the way (cells).
struct RedrawContext {
  const Building& building;
  const LabelledBuilding& labelled;  ///< what annotate() says of it
  const Solid& solid;                ///< of the building
  const Segmentation& segmentation;  ///< of the solid, made with `options`
  const FeatureTable& table;         ///< gives features their ids
  const Interpretation& interpretation;
  SegmentOptions options{};
  /// What must not change, and what must not be drawn.
  Invariants invariants{};
  /// If given, what has no cut of its own goes as cells where that leaves what it calls fit
  /// (remove_cells).
  SolidJudge* judge = nullptr;
  /// What is left after cuts is judged also if all of them went well.
  bool judges_all = false;
  /// If given, what is done is counted in it; once it is used up nothing more is tried, and what
  /// was not carried out by then is refused (E502).
  Work* work = nullptr;
  /// Features that went together before, ascending: they are tried first, and may go whatever short
  /// edges that leaves.
  std::vector<FeatureId> settled{};
  /// Imprints that stay but get no facet of their own, ascending.
  std::vector<FeatureId> undrawn{};
  /// Of `solid`, before anything is changed; given once violations matter.
  std::optional<Measures> before{};
  /// The cells of the segmentation, for all that is tried with it; null: they are found each time.
  std::shared_ptr<detail::BuildingCells> cells{};

  /// An issue of the building, or of one of its features.
  [[nodiscard]] Issue issue(Severity severity, Code code, FeatureId of, std::string sentence) const;

  [[nodiscard]] const Feature& feature(FeatureId id) const {
    return segmentation.features[id.index()];
  }
  /// False also if no work is given.
  [[nodiscard]] bool has_no_work_left() const { return work != nullptr && work->is_used_up(); }
  /// Counts work on a solid, `steps` for each of its corners. False once there is none left.
  [[nodiscard]] bool may_go_on(const Solid& on, std::int64_t steps) const;
  /// `cells`, or new ones if there are none.
  [[nodiscard]] std::shared_ptr<detail::BuildingCells> shared_cells() const;
  /// What changed that must not if this is left; nothing if nobody asks.
  [[nodiscard]] std::optional<Violation> violation_by(const Solid& left) const;
};

}  // namespace oriel
