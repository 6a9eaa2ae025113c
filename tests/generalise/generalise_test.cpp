#include "generalise/generalise.h"

#include "generalise/carry_out.h"
#include "generalise/invariants/fineness.h"
#include "generalise/series/series_levels.h"
#include "tests/generalise/bare_context.h"
#include "tests/generalise/line.h"
#include "tests/support/changed.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

const std::vector<double> kScales{1, 100, 500, 1000, 2000, 2500, 5000, 10000, 20000, 50000};

/// What taking the features off changes the volume by: those inside another one that goes are part
/// of it.
double change_m3(const Line& line, const std::vector<FeatureId>& removed) {
  const std::set<FeatureId> gone(removed.begin(), removed.end());
  double sum = 0;
  for (const FeatureId id : removed) {
    const Feature& feature = line.segmentation.features[id.index()];
    if (gone.contains(feature.parent)) continue;
    sum += feature.sense == Sense::protrusion ? -feature.volume_m3 : feature.volume_m3;
  }
  return sum;
}

/// A plinth of 6 cm around a block, cut into pieces by a door.
Building block_on_a_plinth() {
  return BoxBody()
      .add({0, 0, 0}, {10, 8, 6})
      .add({-0.06, -0.06, 0}, {10.06, 8.06, 0.45})
      .remove({3, -0.06, 0}, {4, 0, 0.45})
      .build();
}

/// The block, with a plan that takes off what is shorter than 5 m, as a target does for its size.
struct Plinth {
  Line line;
  Plan plan{10000, {}, {}};

  explicit Plinth(Building block) : line(line_of(std::move(block))) {
    for (Verdict& verdict : line.interpretation.verdicts) verdict.label.clear();
    for (int i = 0; i < static_cast<int>(line.table().rows()); ++i)
      if (line.table().number(FeatureId{i}, Attribute::a) < 5.0)
        plan.steps.push_back({FeatureId{i}, "omit", "small.omit"});
    REQUIRE_FALSE(plan.steps.empty());
  }

  [[nodiscard]] Generalised generalised(double least_edge_m) const {
    Invariants invariants;
    invariants.least_edge_m = least_edge_m;
    auto out = generalise(line.context(invariants), plan);
    REQUIRE(out.value);
    return std::move(*out.value);
  }

  [[nodiscard]] std::size_t stubs(const Generalised& of) const {
    return new_short_edges(line.context(), of.solid, of.removed, 1.25).size();
  }
};

/// Its plan at scales 1 to n, each with its least edge.
class PlinthOrder : public SeriesOrder {
 public:
  PlinthOrder(const Plinth& plinth, std::vector<double> least_edges_m)
      : plinth_(plinth), least_edges_m_(std::move(least_edges_m)) {}

  [[nodiscard]] Plan plan_at(double /*scale*/) const override { return plinth_.plan; }
  [[nodiscard]] Invariants invariants_at(double scale) const override {
    Invariants invariants;
    invariants.least_edge_m = least_edges_m_.at(static_cast<std::size_t>(scale) - 1);
    return invariants;
  }

 private:
  const Plinth& plinth_;
  std::vector<double> least_edges_m_;
};

/// What is carried out of a plan with so much work.
Generalised carried_out(const Line& line, const Plan& plan, Work& work) {
  RedrawContext context = line.context();
  context.work = &work;
  Generalised done = carry_out(context, plan);
  CHECK(is_closed(done.solid));
  return done;
}

std::ptrdiff_t without_work(const Generalised& done) {
  return std::ranges::count(done.refused, Code::E502, &RefusedStep::code);
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("every sample is closed at every scale and its volume adds up") {
    for (const std::string& name : samples()) {
      const Line line = line_of_sample(name);
      const double before = volume_m3(line.solid);
      for (const double scale : kScales) {
        CAPTURE(name);
        CAPTURE(scale);
        const Coarser coarser = generalised(line, scale);
        CHECK(is_closed(coarser.generalised.solid));
        const double after = volume_m3(coarser.generalised.solid);
        CHECK(after - before - change_m3(line, coarser.generalised.removed) ==
              doctest::Approx(0).epsilon(1e-6));
      }
    }
  }

  TEST_CASE("a coarser scale removes what a finer one removes") {
    for (const std::string& name : samples()) {
      const Line line = line_of_sample(name);
      std::vector<FeatureId> finer;
      for (const double scale : kScales) {
        CAPTURE(name);
        CAPTURE(scale);
        const auto removed = generalised(line, scale).generalised.removed;
        CHECK(std::ranges::is_sorted(removed));
        CHECK(std::ranges::includes(removed, finer));
        finer = removed;
      }
    }
  }

  TEST_CASE("at 1:1 nothing changes") {
    for (const std::string& name : samples()) {
      CAPTURE(name);
      const Line line = line_of_sample(name);
      const Coarser coarser = generalised(line, 1);
      CHECK(coarser.plan.steps.empty());
      CHECK(coarser.generalised.removed.empty());
      CHECK(coarser.redrawn.removed_ids.empty());
      CHECK(coarser.generalised.solid.facets.size() == line.solid.facets.size());
      CHECK(volume_m3(coarser.generalised.solid) ==
            doctest::Approx(volume_m3(line.solid)).epsilon(1e-12));
    }
  }

  TEST_CASE("no sample has a warning at 1:20000") {
    for (const std::string& name : samples()) {
      CAPTURE(name);
      for (const Issue& issue : generalised(line_of_sample(name), 20000).issues)
        CHECK_MESSAGE(issue.severity == Severity::note, to_string(issue));
    }
  }

  TEST_CASE("at 1:20000 a house has neither openings nor chimney nor balcony") {
    for (const std::string& name : samples()) {
      CAPTURE(name);
      const Line line = line_of_sample(name);
      const Coarser coarser = generalised(line, 20000);
      const auto& removed = coarser.generalised.removed;
      for (const std::string label : {"window", "door", "chimney", "vent", "balcony", "loggia",
                                      "dormer", "bay", "canopy", "stairs"})
        for (const FeatureId id : line.features(label)) {
          CAPTURE(line.table().id(id));
          CHECK(std::ranges::binary_search(removed, id));
        }
    }
  }

  TEST_CASE("the cells of every sample sum up to its volume") {
    for (const std::string& name : samples()) {
      CAPTURE(name);
      const Line line = line_of_sample(name);
      double sum = 0;
      for (const Cell& cell : line.segmentation.cells) sum += cell.sign * cell.volume_m3;
      CHECK(sum == doctest::Approx(volume_m3(line.solid)).epsilon(1e-9));
    }
  }

  TEST_CASE("a piece of a part that stays is a note and a labelled feature a warning") {
    Line line = line_of_sample("house");
    const auto pieces = generalised(line, 2000).issues;
    REQUIRE(!pieces.empty());
    for (const Issue& issue : pieces) {
      CHECK(issue.severity == Severity::note);
      CHECK(issue.code == Code::G401);
      CHECK(issue.sentence.find("is a piece of f") == 0);
      const FeatureId id = line.table().find(issue.place.feature);
      REQUIRE(id.is_valid());
      CHECK(line.segmentation.features[id.index()].parent.is_valid());
      line.interpretation.verdicts[id.index()].label = "vent";
    }
    const auto issues = generalised(line, 2000).issues;
    CHECK(issues.size() == pieces.size());
    for (const Issue& issue : issues) {
      CHECK(issue.severity == Severity::warning);
      CHECK(issue.sentence.find("is not omitted at 1:2000: ") == 0);
      CHECK(issue.place.building == "house");
    }
  }

  TEST_CASE("a feature that is refused is not counted as removed") {
    const Line line = line_of_sample("house");
    const Coarser coarser = generalised(line, 2000);
    for (const Issue& issue : coarser.issues)
      CHECK(!std::ranges::binary_search(coarser.generalised.removed,
                                        line.table().find(issue.place.feature)));
  }

  TEST_CASE("a piece of a plinth does not go while the rest of it stays") {
    const Plinth plinth(block_on_a_plinth());
    const Generalised torn = plinth.generalised(0), whole = plinth.generalised(1.25);
    CHECK(torn.refused.empty());
    CHECK(plinth.stubs(torn) > 0);
    CHECK(plinth.stubs(whole) == 0);
    REQUIRE_FALSE(whole.refused.empty());
    for (const auto& refused : whole.refused) {
      CHECK(refused.code == Code::G418);
      CHECK(is_part(refused, plinth.plan, plinth.line.interpretation));
    }
  }

  TEST_CASE(
      "a piece of a plinth does not go while the rest of it stays, where edges are off by noise") {
    int torn = 0;
    for (const std::uint64_t seed :
         {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20}) {
      CAPTURE(seed);
      const Plinth plinth(with_noise(block_on_a_plinth(), 0.00125, seed));
      torn += plinth.stubs(plinth.generalised(0)) > 0;
      CHECK(plinth.stubs(plinth.generalised(1.25)) == 0);
    }
    CHECK(torn > 0);
  }

  TEST_CASE("in a series a piece of a plinth stays as well, and what went before stays gone") {
    const Plinth plinth(block_on_a_plinth());
    const auto levels_with = [&](std::vector<double> least_edges_m) {
      auto levels = series_levels(plinth.line.context(),
                                  PlinthOrder(plinth, std::move(least_edges_m)), {1, 2});
      REQUIRE(levels.value);
      return std::move(*levels.value);
    };
    for (const SeriesLevel& level : levels_with({1.25, 2.5}))
      CHECK(plinth.stubs(level.generalised) == 0);
    const auto torn = levels_with({0, 1.25});
    CHECK_FALSE(torn[1].generalised.removed.empty());
    CHECK(torn[2].generalised.removed == torn[1].generalised.removed);
  }

  TEST_CASE("a solid of which nothing is left stays as it is") {
    const Checked<Generalised> out = generalise(bare_context({}, {}), Plan{500, {}, {}});
    CHECK(!out.value);
    REQUIRE(out.issues.size() == 1);
    CHECK(out.issues[0].code == Code::G402);
    CHECK(out.issues[0].severity == Severity::error);
    CHECK(out.issues[0].place.building == "house");
    CHECK(out.issues[0].sentence.find("1:500") != std::string::npos);
  }

  TEST_CASE("drawing counts as work and stops when none is left") {
    const Line line = line_of_sample("house");
    const RuleBase cartographic = *load_pack_file("cartographic").value;
    Plan omitted = line.plan_at(2500, cartographic);
    const Plan drawn = omitted;
    for (Step& step : omitted.steps) step = {step.feature, "omit", step.rule};
    const auto fewest = [&](const Plan& asked) {
      std::int64_t enough = 1;
      for (bool is_enough = false; !is_enough; enough += enough / 8 + 1) {
        Work work(enough);
        const auto stays = without_work(carried_out(line, asked, work));
        is_enough = !work.is_used_up();
        CHECK((is_enough ? stays == 0 : stays > 0));
      }
      return enough;
    };
    CHECK(fewest(drawn) > fewest(omitted));
  }

  TEST_CASE("what there is no work left for stays and says so") {
    const Line line = line_of_sample("house");
    const Plan asked = line.plan_at(2500);
    REQUIRE(!asked.steps.empty());
    for (const std::int64_t budget : {1, 10'000, 100'000, 1'000'000, 40'000'000}) {
      CAPTURE(budget);
      Work work(budget);
      const Generalised done = carried_out(line, asked, work);
      const auto stays = without_work(done);
      CHECK((stays == 0 || work.is_used_up()));
      if (budget == 1) {
        CHECK(stays == std::ssize(asked.steps));
        CHECK(done.removed.empty());
        CHECK(done.solid.facets.size() == line.solid.facets.size());
      }
      if (budget == 40'000'000) CHECK(!work.is_used_up());
    }
  }
}
