#include "generalise/carry_out.h"

#include "generalise/removal/building_cells.h"
#include "tests/generalise/bare_context.h"
#include "tests/generalise/line.h"
#include "tests/support/changed.h"
#include "tests/support/houses.h"
#include "tests/support/segmented.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

void tell(Vec3 p, std::string& text) { text += fmt::format(" {:a} {:a} {:a}", p.x, p.y, p.z); }

void tell(std::string_view what, const std::vector<FeatureId>& features, std::string& text) {
  text += fmt::format("\n{}", what);
  for (const FeatureId id : features) text += fmt::format(" {}", id.value);
}

/// All that was made, to the last bit.
std::string told(const Generalised& made) {
  std::string text;
  for (const Plane& plane : made.solid.planes) {
    text += fmt::format("\nplane {} {} {:a}", plane.coefficients, plane.offset, plane.offset_m);
    tell(plane.normal, text);
  }
  for (const Vertex& vertex : made.solid.vertices) {
    text += vertex.is_meeting ? "\nmeeting" : "\nvertex";
    tell(vertex.point, text);
  }
  for (const Facet& facet : made.solid.facets)
    text += fmt::format("\nfacet {} {} {}", facet.plane.value, facet.loops, facet.polygons);
  tell("removed", made.removed, text);
  tell("changed", made.changed, text);
  for (const RefusedStep& step : made.refused) {
    text +=
        fmt::format("\nrefused {} {} {}", step.feature.value, to_string(step.code), step.reason);
    for (const Need& need : step.hindrance.needs)
      text += fmt::format(" {} {:a} {:a}", need.what, need.less, need.then);
    tell("beside", step.hindrance.beside, text);
  }
  for (const UnclearedEdge& edge : made.uncleared) {
    text += "\nuncleared " + edge.reason;
    tell(edge.from, text);
    tell(edge.to, text);
  }
  for (const PushedFeature& one : made.pushed) tell("pushed", {one.feature, one.by}, text);
  for (const AlongFeature& one : made.along) {
    tell("along", {one.feature, one.with}, text);
    tell(one.reason, one.beside, text);
  }
  for (const FollowingFeature& one : made.following) {
    tell("following", {one.feature, one.with}, text);
    tell(one.box.min, text);
    tell(one.box.max, text);
  }
  return text;
}

/// From where one text is another one: the rest of its line, or nothing.
std::string difference(const std::string& is, const std::string& wanted) {
  const auto from = std::ranges::mismatch(is, wanted).in1;
  if (is == wanted) return {};
  return "differs: " + std::string(from, std::find(from, is.end(), '\n'));
}

/// It finds half of all solids unfit, so that much is tried as cells: quick on small bodies.
SolidJudge& strict() {
  static JudgeBy judge([](const Solid& solid) {
    return is_closed(solid) && solid.facets.size() % 2 == 0 ? Fitness::valid : Fitness::unfit;
  });
  return judge;
}

Line noisy_dormer(std::uint64_t seed) {
  return line_of(with_noise(dormer_with_window(), 0.002, seed));
}

/// The context with cells, once a plan was carried out with it.
RedrawContext tried(RedrawContext context, const Plan& plan) {
  context.cells = std::make_shared<detail::BuildingCells>(context.solid, context.segmentation,
                                                          context.options.tolerances);
  carry_out(context, plan);
  return context;
}

Plan omitting(const std::vector<FeatureId>& features) {
  Plan plan{5000, {}, {}};
  for (const FeatureId id : features) plan.steps.push_back({id, "omit", "test"});
  return plan;
}

/// What a pack asks of a building at some scale, or to omit all its features; of that any part.
Plan any_plan(const Line& line) {
  static const RuleBase cartographic = *load_pack_file("cartographic").value;
  Plan plan;
  if (*rc::gen::element(true, false, false))
    plan = omitting(all_features(line.segmentation));
  else
    plan = line.plan_at(*rc::gen::element(1000., 2500., 4000., 10000.), cartographic);
  const auto any_percent = rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, 100));
  const int percent = *rc::gen::element(20, 60, 100);
  std::erase_if(plan.steps, [&](const Step&) { return *any_percent >= percent; });
  return plan;
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("what is tried with a context changes nothing of what is tried after it") {
    const std::vector<Line> lines{line_of_sample("l-house"), line_of_sample("row"), noisy_dormer(1),
                                  noisy_dormer(2)};
    std::size_t with_cells = 0;
    CHECK(rc::check([&] {
      const auto which = *rc::gen::element<std::size_t>(0, 1, 2, 2, 3, 3);
      const Line& line = lines[which];
      RedrawContext context = line.context();
      const bool is_sample = which < 2;
      context.judge =
          is_sample ? *rc::gen::element<SolidJudge*>(nullptr, &any_closed()) : &strict();
      context.judges_all = !is_sample;
      context.invariants.least_edge_m = *rc::gen::element(0.0, 0.3);
      if (*rc::gen::arbitrary<bool>()) context.invariants.limits.volume_pct = 0.5;
      const RedrawContext used = tried(context, any_plan(line));
      with_cells += used.cells->known_complex() != nullptr ? 1 : 0;
      const Plan plan = any_plan(line);
      RC_ASSERT(difference(told(carry_out(used, plan)), told(carry_out(context, plan))) == "");
    }));
    CHECK(with_cells > 0);
  }

  TEST_CASE("what goes as cells does not depend on whether the cells were known before") {
    const Line line = noisy_dormer(1);
    RedrawContext context = line.context();
    context.judge = &strict();
    context.judges_all = true;
    context.invariants.least_edge_m = 0.3;
    const RedrawContext used = tried(context, omitting(all_features(line.segmentation)));
    CHECK(used.cells->known_complex() != nullptr);
    const Plan plan = omitting({{0}, {2}, {3}, {4}, {6}, {8}, {9}});
    CHECK(difference(told(carry_out(used, plan)), told(carry_out(context, plan))) == "");
  }
}
