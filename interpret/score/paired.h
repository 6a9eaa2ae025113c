#pragma once

#include "interpret/score/score.h"
#include "interpret/score/score_spread.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// What a run came to on one building: as much as a comparison with another run needs.
struct OutcomeOfBuilding {
  /// Score::classes.
  std::map<std::string, ClassScore> classes;
  /// Label and id of the true objects that were not found, or were called something else; sorted.
  std::vector<std::pair<std::string, std::string>> missed;
};

/// By building.
using RunOutcomes = std::map<std::string, OutcomeOfBuilding>;

/// What paired comparisons take from a score. `options` are those it was made with.
OutcomeOfBuilding outcome_of(const Score& score, const ScoreOptions& options = {});

/// The outcomes of two runs on the same buildings, first and second: a building that only one of
/// the maps has (because the other run labelled nothing there, and nothing is there) is an empty
/// outcome of the other.
std::pair<RunOutcomes, RunOutcomes> paired_outcomes(const std::map<std::string, Score>& first,
                                                    const std::map<std::string, Score>& second,
                                                    const ScoreOptions& options = {});

/// How two runs differ in one class, or in all. Values without a denominator are NaN, and so are
/// differences from them.
struct ClassDifference {
  /// F1 of both runs; of all classes macro-F1.
  double first_f1 = 0;
  double second_f1 = 0;
  /// second - first, and where 95 % of the samples have it.
  double f1 = 0;
  ConfidenceInterval interval;
  /// The same of the runs themselves, from the same samples: equal to those of bootstrap().
  ConfidenceInterval first_interval;
  ConfidenceInterval second_interval;
  /// True objects that are found by the first run only, and by the second only.
  std::size_t only_first = 0;
  std::size_t only_second = 0;
  /// mcnemar_p() of these two.
  double p = 1;
};

struct PairedComparison {
  std::size_t samples = 0;
  /// Of every class that one of the runs has.
  std::map<std::string, ClassDifference> classes;
  /// Of macro-F1, and of the true objects of all classes.
  ClassDifference all;
};

/// Compares runs with one run on the same buildings, by the paired bootstrap over buildings (Efron
/// and Tibshirani 1993, chapter 13): the drawn buildings are the same for both runs and those of
/// bootstrap(), so that what makes a building easy or hard for both does not blur the difference.
/// What a class did not have in a sample (or, for a difference, in one of the runs there) says
/// nothing of it.
///
/// The test pairs true objects: each is found or missed by either run. A prediction has no partner
/// in the other run, which may have other features; what was predicted wrongly counts in F1 and in
/// its interval, not in the test.
///
/// A comparison costs time by the buildings in which the runs differ, so one of these is made for
/// many runs. It may be used by several threads.
class PairedComparer {
 public:
  /// `samples`: at least 1.
  PairedComparer(RunOutcomes first, std::size_t samples);

  /// `second` has the buildings of the first run.
  [[nodiscard]] PairedComparison compare(const RunOutcomes& second) const;

 private:
  void for_each_sample(
      const std::function<void(std::size_t, std::span<const std::uint32_t>)>& visit) const;

  RunOutcomes first_;
  std::size_t samples_ = 0;
  /// Those of the first run, sorted; and the sums of its counts in each sample, in their order.
  std::vector<std::string> labels_;
  std::vector<ClassScore> sums_;
  /// How often a building is in a sample, sample by sample; empty if that is too large to keep.
  std::vector<std::uint32_t> times_drawn_;
};

/// The exact two-sided test of McNemar (1947), as a binomial test: the probability that of
/// `only_first` + `only_second` fair coins the smaller side is no larger than here, both ways; at
/// most 1, and 1 without any. It is not approximated, whatever the counts.
double mcnemar_p(std::size_t only_first, std::size_t only_second);

/// For a terminal, a line a class; and one JSON object on one line (docs/formats.md).
std::string to_text(const PairedComparison& comparison);
std::string to_json(const PairedComparison& comparison);

}  // namespace oriel
