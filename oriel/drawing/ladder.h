#pragma once

#include "generalise/context.h"
#include "generalise/series/series_levels.h"
#include "interpret/pack/rule_base.h"
#include "io/document.h"
#include "kernel/base/issue.h"
#include "kernel/base/work.h"
#include "model/labelled_building.h"
#include "oriel/drawing/output_check.h"
#include "oriel/generalise.h"
#include "oriel/label.h"
#include "oriel/result.h"
#include "oriel/stage.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace oriel {

/// How what is cut is judged on the way, by how it would be written.
enum class Judging {
  none,      ///< not at all: it would take too long
  refused,   ///< where features do not come off, what is left instead
  thorough,  ///< every step (RedrawContext::judges_all)
};

/// What a building is drawn from: its own solid, or a repaired one. Refers to the building.
struct DrawingSource {
  std::shared_ptr<const PipelineResult> result;
  LabelledBuilding labelled;  ///< what annotate() says of it
  Work work;                  ///< of all targets and all ways that are tried with it
  /// It is a repaired_solid(): what would be folded as it is written is parted (OutputCheck::part).
  bool is_repaired = false;
  /// Its solid is valid only once it is mended (OutputCheck::made_valid), and so is what is drawn.
  bool is_parted = false;
  std::shared_ptr<detail::BuildingCells> cells{};
};

/// A building drawn in one way, for all its targets.
struct Drawn {
  std::shared_ptr<DrawingSource> source{};
  Judging judging = Judging::refused;
  std::vector<FeatureId> undrawn{};  ///< RedrawContext::undrawn
  /// One for each target; of a series the building as it came before them. Empty after an error.
  std::vector<SeriesLevel> levels{};
  std::vector<TargetReport> reports{};
  std::vector<Issue> issues{};
  /// Why a level must not be written: G410, or G413 if the building was not valid when it was read.
  std::optional<Issue> fault{};
  /// The same of a series' building as it came.
  std::optional<Issue> finest_fault{};
  std::optional<std::int64_t> used_up_budget{};  ///< of its work: not all was tried

  [[nodiscard]] bool has_fault() const { return fault || finest_fault; }
  [[nodiscard]] bool is_valid() const {
    return !has_fault() && !levels.empty() && !has_errors(issues);
  }
  [[nodiscard]] bool is_unfinished() const { return source->work.is_used_up(); }
  /// How good it is: not valid, valid as far as the work lasted, or the best.
  static constexpr int kBest = 2;
  [[nodiscard]] int rank() const { return !is_valid() ? 0 : is_unfinished() ? 1 : kBest; }
};

/// Draws one building so that it is valid as it is written, in the first of these ways that is:
///
/// 1. as its plan asks, from its own solid, an open one from its cut_solid() (G420)
/// 2. with every step judged, unless the building came invalid: no step can be told to spoil it
/// 3. from its repaired_solid() (G417), as 1 and 2
/// 4. from these solids mended before they are segmented: facets that are parted have planes of
///    their own, which cut features into pieces
/// 5. without the outlines of imprints that are in the way (G410 of each)
///
/// What is valid but not finished, as the work of its solid was used up, gives way to what is. If
/// none is valid it comes as in 1, with its fault, and whoever asks says what becomes of it.
class DrawingLadder {
 public:
  DrawingLadder(const Document& document, const Building& building, const RuleBase& rules,
                const LabelOptions& options)
      : document_(document),
        building_(building),
        rules_(rules),
        options_(options),
        check_(std::make_unique<OutputCheck>(document, building)) {}
  virtual ~DrawingLadder() = default;

  /// `result` is what label() said of the building; it must outlive what is drawn.
  Drawn run(const PipelineResult& result);

 protected:
  /// Draws all levels by drawn.source, drawn.judging and drawn.undrawn.
  virtual void draw_levels(Drawn& drawn) = 0;
  /// Says why they must not be written as they are.
  virtual void check(Drawn& drawn) = 0;
  /// Says whether nobody waits for it any longer.
  virtual bool is_given_up(Stage /*stage*/) { return false; }

  /// Returns what `drawn` is drawn with. `judge` may be null.
  [[nodiscard]] RedrawContext context_of(const Drawn& drawn, SolidJudge* judge) const;
  /// Parts what would be folded as it is written, of a source that is repaired or parted.
  void finish(const DrawingSource& source, LabelledBuilding& labelled) const;
  [[nodiscard]] std::optional<Issue> fault_of(const DrawingSource& source,
                                              const Solid& solid) const;

  const Document& document_;
  const Building& building_;
  const RuleBase& rules_;
  const LabelOptions& options_;
  const std::unique_ptr<OutputCheck> check_;  ///< of all that is tried

 private:
  struct MadeSolid;

  std::shared_ptr<DrawingSource> source_of(std::shared_ptr<const PipelineResult> result,
                                           Work work) const;
  [[nodiscard]] Drawn left_open(const Work& work) const;
  /// Tries the rungs after the first; `solids` are those that were made by then.
  void climb(std::vector<MadeSolid> solids);
  /// Says whether one that was tried is the best.
  [[nodiscard]] bool is_done() const;
  Drawn drawn_as(const std::shared_ptr<DrawingSource>& source, Judging judging,
                 std::vector<FeatureId> undrawn = {});
  /// Draws as the plan asks, and where that is not valid with every step judged.
  void draw_from(const std::shared_ptr<DrawingSource>& source);
  void draw_from(const MadeSolid& solid, bool is_mended);
  void draw_without_imprints();

  std::vector<Drawn> tried_;
};

}  // namespace oriel
