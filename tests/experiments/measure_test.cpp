#include "experiments/results/measure.h"

#include "experiments/results/planned_runs.h"
#include "experiments/results/result_rows.h"
#include "tests/interpret/learn/random_samples.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// Buildings of their own, each with some features and objects.
std::vector<Sample> some_samples(std::uint64_t seed) {
  std::vector<Sample> samples;
  for (int i = 0; i < 4; ++i) {
    Sample sample = random_sample(seed + static_cast<std::uint64_t>(i), 12);
    const std::string name = fmt::format("b{}", i);
    FeatureTable named(name, sample.features.table.rows());
    for (std::size_t row = 0; row < named.rows(); ++row) {
      const FeatureId id{static_cast<int>(row)};
      named.set_id(id, sample.features.table.id(id));
      for (const Attribute attribute : kAttributes) {
        if (info_of(attribute).unit == Unit::text)
          named.set(id, attribute, std::string(sample.features.table.text(id, attribute)));
        else if (const auto number = sample.features.table.number(id, attribute))
          named.set(id, attribute, *number);
      }
    }
    sample.features.table = std::move(named);
    for (std::size_t o = 0; o < sample.truth.size(); ++o) {
      sample.truth[o].building = name;
      sample.truth[o].id = fmt::format("o{}", o);
    }
    samples.push_back(std::move(sample));
  }
  return samples;
}

bool is_same_outcome(const RunOutcomes& p, const RunOutcomes& q) {
  return std::ranges::equal(p, q, [](const auto& a, const auto& b) {
    return a.first == b.first && a.second.missed == b.second.missed &&
           is_same(a.second.classes, b.second.classes);
  });
}

RuleBase residential() {
  auto loaded = load_pack_file("residential");
  REQUIRE(loaded.value);
  return *loaded.value;
}

}  // namespace

TEST_SUITE("experiments") {
  TEST_CASE("the engine gives the outcomes that labelling and scoring each variant give") {
    const RuleBase rules = residential();
    SweepPlan sweep;
    sweep.params = {{"widest_window", {3, 5}, 3, 5, "m"}, {"narrowest", {0.2, 0.4}, 0.2, 0.4, "m"}};
    sweep.design = SweepPlan::Design::grid;
    std::vector<PlannedRun> runs = runs_of(sweep, 1);
    const auto ablated = runs_of({true, true, true, {}}, rules);
    for (std::size_t i = 0; i < ablated.size(); i += 9) runs.push_back(ablated[i]);
    std::vector<Variant> variants;
    for (const PlannedRun& run : runs) variants.push_back(run.variant);
    const auto samples = some_samples(5);
    const auto counts = count_variants(rules, variants, samples);
    REQUIRE(counts.value);
    for (std::size_t i = 0; i < variants.size(); ++i) {
      CAPTURE(variants[i].name);
      const auto own = with_variant(rules, variants[i]);
      REQUIRE(own.value);
      CHECK(is_same_outcome(outcomes_of(*counts.value, i, samples), measure(*own.value, samples)));
    }
  }

  TEST_CASE("a grid has all combinations and a random sweep depends on its seed alone") {
    SweepPlan sweep;
    sweep.params = {{"a", {1, 2}, 1, 2, "m"}, {"b", {3, 4, 5}, 3, 5, ""}};
    sweep.design = SweepPlan::Design::grid;
    const auto grid = runs_of(sweep, 1);
    REQUIRE(grid.size() == 6);
    CHECK(grid[1].setting.name == "a = 1 m, b = 4");
    sweep.design = SweepPlan::Design::random;
    sweep.samples = 20;
    const auto draws = runs_of(sweep, 7), again = runs_of(sweep, 7), others = runs_of(sweep, 8);
    REQUIRE(draws.size() == 20);
    bool is_other = false;
    for (std::size_t i = 0; i < draws.size(); ++i) {
      CHECK(draws[i].variant.params == again[i].variant.params);
      is_other |= draws[i].variant.params != others[i].variant.params;
      CHECK(draws[i].variant.params[0].value >= 1);
      CHECK(draws[i].variant.params[0].value <= 2);
    }
    CHECK(is_other);
    CHECK(table_of_draws(sweep, draws).rows.size() == 20);
  }

  TEST_CASE("runs of an ablation have names of their own") {
    const auto runs = runs_of({true, true, true, {}}, residential());
    std::vector<std::string> names;
    for (const PlannedRun& run : runs) names.push_back(run.setting.name);
    std::ranges::sort(names);
    CHECK(std::ranges::adjacent_find(names) == names.end());
    CHECK(runs_of({true, false, false, {}}, residential()).size() == residential().rule_count());
  }

  TEST_CASE("rows have the counts of all buildings and the difference from the baseline") {
    const RuleBase rules = residential();
    const auto samples = some_samples(9);
    const RunOutcomes own = measure(rules, samples);
    const std::vector<ParamValue> narrow{{"widest_window", 2.5}};
    const RunOutcomes other = measure(*with_params(rules, narrow).value, samples);
    const ResultRows rows(ExperimentPart::compare, "s", own, 100);
    RunSetting setting;
    setting.name = "narrow";
    const auto baseline = rows.baseline_rows("residential", {});
    for (const ResultRow& row : baseline) {
      CHECK(row.setting.is_baseline);
      CHECK_FALSE(row.difference);
    }
    const auto compared = rows.rows_of("residential", setting, other);
    REQUIRE(compared.size() == baseline.size());
    for (std::size_t i = 0; i < compared.size(); ++i) {
      REQUIRE(compared[i].label == baseline[i].label);
      REQUIRE(compared[i].difference);
      if (!std::isnan(compared[i].f1) && !std::isnan(baseline[i].f1))
        CHECK(compared[i].difference->f1 ==
              doctest::Approx(compared[i].f1 - baseline[i].f1).epsilon(1e-12));
    }
    CHECK(compared.back().label.empty());
    // The same run once more differs in nothing.
    for (const ResultRow& row : rows.rows_of("residential", setting, own)) {
      CHECK((row.difference->f1 == 0 || std::isnan(row.difference->f1)));
      CHECK(row.difference->p == 1);
    }
  }
}
