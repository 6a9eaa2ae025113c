#include "oriel/drawing/ladder.h"

#include "oriel/drawing/faulty_imprints.h"
#include "oriel/drawing/output_check.h"
#include "oriel/drawing/repair_and_retry.h"
#include "oriel/drawing/targets.h"

#include <utility>

namespace oriel {

Drawn DrawingLadder::run(const PipelineResult& result) {
  // It is not owned: the caller has it.
  std::shared_ptr<const PipelineResult> from(std::shared_ptr<const PipelineResult>(), &result);
  if (result.is_open()) {
    Work work = drawing_work(options_.budget);
    auto closed = repair_open(document_, building_, result, rules_, options_, work);
    if (!closed) {
      Drawn none;
      none.issues.push_back(stays_open(building_));
      if (work.is_used_up()) none.used_up_budget = work.budget();
      return none;
    }
    from = std::make_shared<const PipelineResult>(std::move(*closed));
  }
  const auto source = source_of(from, drawing_work(options_.budget), false);
  Drawn drawn = drawn_judged(source);
  if (drawn.has_fault() && !is_given_up(Stage::solidify)) {
    auto other = drawn_repaired(*source);
    if (!other) other = drawn_without_imprints(drawn);
    if (other) drawn = std::move(*other);
  }
  if (result.is_open()) drawn.issues.insert(drawn.issues.begin(), from->issues.back());
  const Work& work = drawn.source->work;
  if (work.is_used_up()) drawn.used_up_budget = work.budget();
  return drawn;
}

RedrawContext DrawingLadder::context_of(const Drawn& drawn, SolidJudge* judge) const {
  DrawingSource& source = *drawn.source;
  RedrawContext context = redraw_context(building_, *source.result, source.labelled, options_);
  if (drawn.judging != Judging::none) context.judge = judge;
  context.judges_all = drawn.judging == Judging::thorough;
  context.work = &source.work;
  context.undrawn = drawn.undrawn;
  context.cells = source.cells;
  return context;
}

void DrawingLadder::finish_repaired(const DrawingSource& source, LabelledBuilding& labelled) const {
  if (source.is_repaired) part_written(document_, building_, labelled);
}

std::optional<Issue> DrawingLadder::fault_of(const DrawingSource& source,
                                             const Solid& solid) const {
  return check_redrawn(document_, building_, *source.result->solid, solid);
}

std::shared_ptr<DrawingSource> DrawingLadder::source_of(
    std::shared_ptr<const PipelineResult> result, Work work, bool is_repaired) const {
  auto source = std::make_shared<DrawingSource>(DrawingSource{
      result, annotate(building_, *result, rules_, options_), std::move(work), is_repaired});
  source->cells = redraw_context(building_, *result, source->labelled, options_).shared_cells();
  return source;
}

Drawn DrawingLadder::drawn_as(const std::shared_ptr<DrawingSource>& source, Judging judging,
                              std::vector<FeatureId> undrawn) {
  Drawn drawn;
  drawn.source = source;
  drawn.judging = judging;
  drawn.undrawn = std::move(undrawn);
  measure(options_.observer, Stage::generalise, [&] { draw_levels(drawn); });
  measure(options_.observer, Stage::write, [&] { check(drawn); });
  return drawn;
}

Drawn DrawingLadder::drawn_judged(const std::shared_ptr<DrawingSource>& source) {
  const bool is_hard = source->is_repaired && is_intricate(*source->result);
  Drawn drawn = drawn_as(source, is_hard ? Judging::none : Judging::refused);
  if (is_hard || !drawn.fault || drawn.fault->code == Code::G413 || source->work.is_used_up())
    return drawn;
  Drawn again = drawn_as(source, Judging::thorough);
  return again.fault || again.levels.empty() ? std::move(drawn) : std::move(again);
}

std::optional<Drawn> DrawingLadder::drawn_repaired(const DrawingSource& source) {
  Work work(options_.budget);
  auto repaired = repair_and_retry(document_, building_, *source.result, rules_, options_, work);
  if (!repaired) return std::nullopt;
  const auto result = std::make_shared<const PipelineResult>(std::move(*repaired));
  Drawn drawn = drawn_judged(source_of(result, std::move(work), true));
  if (!drawn.is_valid()) return std::nullopt;
  drawn.issues.insert(drawn.issues.begin(), result->issues.back());
  return drawn;
}

std::optional<Drawn> DrawingLadder::drawn_without_imprints(const Drawn& first) {
  const PipelineResult& result = *first.source->result;
  FaultyImprints faulty;
  const auto add_faulty = [&](const Drawn& drawn) {
    bool has_more = false;
    for (const SeriesLevel& level : drawn.levels)
      if (const auto& solid = level.redrawn.labelled.geometry)
        has_more |= faulty.add(document_, building_, *result.segmentation, *solid);
    return has_more;
  };
  Drawn drawn = first;
  while (!first.source->work.is_used_up() && add_faulty(drawn)) {
    drawn = drawn_as(first.source, first.judging, faulty.ids());
    if (!drawn.is_valid()) continue;
    const auto issues = faulty.issues(result.description.table);
    drawn.issues.insert(drawn.issues.end(), issues.begin(), issues.end());
    return drawn;
  }
  return std::nullopt;
}

}  // namespace oriel
