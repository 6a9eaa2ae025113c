#include "interpret/score/paired.h"

#include <cmath>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace oriel;

namespace {

/// A run on some buildings with so many windows and doors each, of which it finds some, and calls
/// some walls windows.
std::map<std::string, Score> random_run(std::size_t buildings) {
  std::map<std::string, Score> run;
  for (std::size_t b = 0; b < buildings; ++b) {
    Score& score = run["b" + std::to_string(b)];
    for (const char* label : {"door", "window"}) {
      const std::size_t objects = b % 4 + 1;
      ClassScore& counts = score.classes[label];
      for (std::size_t i = 0; i < objects; ++i) {
        if (*rc::gen::inRange(0, 3) != 0) {
          ++counts.true_positives;
          continue;
        }
        ++counts.false_negatives;
        score.misses.push_back(
            {"b" + std::to_string(b), label + std::to_string(i), label, "", "", 0});
      }
      counts.false_positives = *rc::gen::inRange<std::size_t>(0, 3);
    }
  }
  return run;
}

PairedComparison compared(const std::map<std::string, Score>& first,
                          const std::map<std::string, Score>& second, std::size_t samples) {
  auto [one, other] = paired_outcomes(first, second);
  return PairedComparer(std::move(one), samples).compare(other);
}

bool is_same(const ConfidenceInterval& a, const ConfidenceInterval& b) {
  return a.low == b.low && a.high == b.high;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("the p of few pairs is that of the tables") {
    CHECK(mcnemar_p(0, 0) == 1);
    CHECK(mcnemar_p(3, 3) == 1);
    CHECK(mcnemar_p(0, 1) == 1);
    CHECK(mcnemar_p(0, 5) == 0.0625);
    // 2 · (1 + 10 + 45) / 2^10.
    CHECK(mcnemar_p(2, 8) == doctest::Approx(0.109375).epsilon(1e-14));
    CHECK(mcnemar_p(8, 2) == mcnemar_p(2, 8));
  }

  TEST_CASE("p is exact for counts whose probability is no double") {
    // 2^-1999 · 1 is below the smallest double, its sums are not.
    CHECK(mcnemar_p(0, 2000) == 0);
    CHECK(mcnemar_p(0, 1000) == std::exp2(-999));
    // The normal curve with the correction for steps: (|b - c| - 1) / sqrt(b + c).
    const double z = (10'000.0 - 1) / std::sqrt(2'010'000.0) / std::sqrt(2.0);
    CHECK(mcnemar_p(1'000'000, 1'010'000) == doctest::Approx(std::erfc(z)).epsilon(1e-3));
    // The fewest-sided sum of 2^-n · C(n, k) over all k is 1.
    double sum = 0;
    for (std::size_t k = 0; k < 101; ++k)
      sum += k == 0 ? mcnemar_p(0, 201) : mcnemar_p(k, 201 - k) - mcnemar_p(k - 1, 202 - k);
    CHECK(sum == doctest::Approx(1).epsilon(1e-12));
  }

  TEST_CASE("more of the pairs on one side are never more probable") {
    rc::check([] {
      const auto few = *rc::gen::inRange<std::size_t>(0, 300);
      const auto many = few + *rc::gen::inRange<std::size_t>(0, 300);
      const double p = mcnemar_p(few, many);
      RC_ASSERT(p > 0 && p <= 1);
      RC_ASSERT(mcnemar_p(few, many + 1) <= p);
    });
  }

  TEST_CASE("a run does not differ from itself") {
    rc::check([] {
      const auto run = random_run(*rc::gen::inRange<std::size_t>(1, 8));
      const PairedComparison comparison = compared(run, run, 40);
      RC_ASSERT(comparison.all.f1 == 0 && comparison.all.p == 1);
      RC_ASSERT(is_same(comparison.all.interval, {0, 0}));
      RC_ASSERT(comparison.all.only_first == 0 && comparison.all.only_second == 0);
    });
  }

  TEST_CASE("both runs are drawn as a bootstrap of either alone draws") {
    rc::check([] {
      const auto buildings = *rc::gen::inRange<std::size_t>(1, 8);
      const auto first = random_run(buildings);
      const auto second = random_run(buildings);
      const PairedComparison comparison = compared(first, second, 60);
      const Intervals of_first = bootstrap(first, 60);
      const Intervals of_second = bootstrap(second, 60);
      RC_ASSERT(is_same(comparison.all.first_interval, of_first.macro_f1));
      RC_ASSERT(is_same(comparison.all.second_interval, of_second.macro_f1));
      for (const auto& [label, difference] : comparison.classes) {
        RC_ASSERT(is_same(difference.first_interval, of_first.f1.at(label)));
        RC_ASSERT(is_same(difference.second_interval, of_second.f1.at(label)));
      }
      RC_ASSERT(comparison.all.first_f1 == total(first).macro_f1());
      RC_ASSERT(comparison.all.second_f1 == total(second).macro_f1());
    });
  }

  TEST_CASE("the other way round a difference has the other sign") {
    rc::check([] {
      const auto buildings = *rc::gen::inRange<std::size_t>(1, 8);
      const auto first = random_run(buildings);
      const auto second = random_run(buildings);
      const PairedComparison there = compared(first, second, 60);
      const PairedComparison back = compared(second, first, 60);
      for (const auto& [label, difference] : there.classes) {
        const ClassDifference& other = back.classes.at(label);
        RC_ASSERT(difference.f1 == -other.f1);
        RC_ASSERT(is_same(difference.interval, {-other.interval.high, -other.interval.low}));
        RC_ASSERT(difference.only_first == other.only_second && difference.p == other.p);
      }
    });
  }

  TEST_CASE("what is found once is the difference of what is found") {
    rc::check([] {
      const auto buildings = *rc::gen::inRange<std::size_t>(1, 8);
      const auto first = random_run(buildings);
      const auto second = random_run(buildings);
      const PairedComparison comparison = compared(first, second, 1);
      const Score of_first = total(first);
      const Score of_second = total(second);
      for (const auto& [label, difference] : comparison.classes)
        RC_ASSERT(of_first.classes.at(label).true_positives - difference.only_first ==
                  of_second.classes.at(label).true_positives - difference.only_second);
    });
  }

  TEST_CASE("what the truth has but nothing is scored for is in no pair") {
    Score first, second;
    second.misses.push_back({"b", "w", "wall", "p", "window", 0.9});
    second.classes["window"].false_positives = 1;
    const PairedComparison comparison = compared({{"b", first}}, {{"b", second}}, 10);
    CHECK(comparison.all.only_first == 0);
    CHECK(std::isnan(comparison.all.f1));
    CHECK(to_json(comparison).find("\"difference\":null") != std::string::npos);
  }

  TEST_CASE("a building that only one run labelled is one of both") {
    Score found;
    found.classes["window"].true_positives = 2;
    Score wrong;
    wrong.classes["window"].false_positives = 2;
    const PairedComparison comparison = compared({{"a", found}}, {{"a", found}, {"b", wrong}}, 100);
    CHECK(comparison.all.first_f1 == 1);
    CHECK(comparison.all.second_f1 == doctest::Approx(2.0 / 3).epsilon(1e-12));
    CHECK(comparison.all.p == 1);
    CHECK(comparison.all.interval.low < 0);
    CHECK(to_text(comparison).find("window") != std::string::npos);
  }
}
