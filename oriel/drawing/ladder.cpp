#include "oriel/drawing/ladder.h"

#include "oriel/drawing/faulty_imprints.h"
#include "oriel/drawing/repaired.h"
#include "oriel/drawing/targets.h"
#include "oriel/pipeline/pipeline.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace oriel {

/// A solid that was made for a building, and how it is to be drawn.
struct DrawingLadder::MadeSolid : RepairedSolid {
  Work work;
  bool is_repaired = false;
};

Drawn DrawingLadder::run(const PipelineResult& result) {
  std::vector<MadeSolid> solids;
  std::optional<Issue> warning;
  tried_.clear();
  if (!result.is_open()) {
    // It is not owned: the caller has it.
    const std::shared_ptr<const PipelineResult> own(std::shared_ptr<void>(), &result);
    draw_from(source_of(own, drawing_work(options_.budget)));
  } else {
    Work work = drawing_work(options_.budget);
    if (auto cut = cut_solid(*check_, result.tolerances, options_, work)) {
      warning = repaired_first(building_, cut->made.repair);
      solids.push_back({std::move(*cut), drawing_work(options_.budget), false});
      draw_from(solids.back(), false);
    }
    if (tried_.empty()) return left_open(work);
  }
  if (tried_[0].has_fault() && !is_given_up(Stage::solidify)) climb(std::move(solids));
  Drawn drawn = std::move(*std::ranges::max_element(tried_, std::ranges::less{}, &Drawn::rank));
  if (warning) drawn.issues.insert(drawn.issues.begin(), std::move(*warning));
  const Work& work = drawn.source->work;
  if (work.is_used_up()) drawn.used_up_budget = work.budget();
  return drawn;
}

Drawn DrawingLadder::left_open(const Work& work) const {
  Drawn none;
  none.issues.push_back(stays_open(building_));
  if (work.is_used_up()) none.used_up_budget = work.budget();
  return none;
}

void DrawingLadder::climb(std::vector<MadeSolid> solids) {
  Work work(options_.budget);
  if (auto made = repaired_solid(*check_, tried_[0].source->result->tolerances, options_, work)) {
    solids.push_back({std::move(*made), work, true});
    draw_from(solids.back(), false);
  }
  for (const MadeSolid& solid : solids) {
    // What is cut into more pieces would not be finished either.
    if (is_done() || tried_.back().is_unfinished()) break;
    if (solid.mended) draw_from(solid, true);
  }
  if (!is_done()) draw_without_imprints();
}

bool DrawingLadder::is_done() const {
  return std::ranges::any_of(tried_, [](const Drawn& one) { return one.rank() == Drawn::kBest; });
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

void DrawingLadder::finish(const DrawingSource& source, LabelledBuilding& labelled) const {
  if (source.is_parted || source.is_repaired) check_->part(labelled);
}

std::optional<Issue> DrawingLadder::fault_of(const DrawingSource& source,
                                             const Solid& solid) const {
  return check_->fault_of_redrawn(*source.result->solid, source.is_parted, solid);
}

std::shared_ptr<DrawingSource> DrawingLadder::source_of(
    std::shared_ptr<const PipelineResult> result, Work work) const {
  auto source = std::make_shared<DrawingSource>(
      DrawingSource{result, annotate(building_, *result, rules_, options_), std::move(work)});
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

void DrawingLadder::draw_from(const std::shared_ptr<DrawingSource>& source) {
  const bool is_hard = source->is_repaired && is_intricate(*source->result->solid);
  Drawn drawn = drawn_as(source, is_hard ? Judging::none : Judging::refused);
  const bool may_help = !is_hard && drawn.fault && drawn.fault->code != Code::G413;
  tried_.push_back(std::move(drawn));
  if (!may_help || source->work.is_used_up()) return;
  Drawn again = drawn_as(source, Judging::thorough);
  if (!again.fault && !again.levels.empty()) tried_.back() = std::move(again);
}

void DrawingLadder::draw_from(const MadeSolid& solid, bool is_mended) {
  PipelineResult made = solid.made;
  if (is_mended) made.solid = solid.mended;
  const Tolerances tolerances = made.tolerances;
  auto result = std::make_shared<const PipelineResult>(
      run_from_solid(std::move(made), building_, &rules_, tolerances, options_));
  if (!result->is_done() || result->is_open()) return;
  const auto source = source_of(std::move(result), solid.work);
  source->is_repaired = solid.is_repaired;
  source->is_parted = solid.mended && !is_mended;
  draw_from(source);
  if (solid.is_repaired)
    tried_.back().issues.insert(tried_.back().issues.begin(),
                                redrawn_from_inside(*check_, solid.made.repair));
}

void DrawingLadder::draw_without_imprints() {
  const Drawn& first = tried_[0];
  const PipelineResult& result = *first.source->result;
  FaultyImprints faulty;
  const auto add_faulty = [&](const Drawn& drawn) {
    bool has_more = false;
    for (const SeriesLevel& level : drawn.levels)
      if (const auto& solid = level.redrawn.labelled.geometry)
        has_more |= faulty.add(*check_, *result.segmentation, *solid);
    return has_more;
  };
  Drawn drawn = first;
  while (!first.source->work.is_used_up() && add_faulty(drawn)) {
    drawn = drawn_as(first.source, first.judging, faulty.ids());
    if (!drawn.is_valid()) continue;
    const auto issues = faulty.issues(result.description.table);
    drawn.issues.insert(drawn.issues.end(), issues.begin(), issues.end());
    tried_.push_back(std::move(drawn));
    return;
  }
}

}  // namespace oriel
