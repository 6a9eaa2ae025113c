#pragma once

#include "interpret/learn/learning_set.h"

#include <cstddef>
#include <span>
#include <vector>

namespace oriel {

/// What is gained by less is rounding.
inline constexpr double kLeastGain = 1e-9;

/// A search for the best setting on some samples.
struct SearchRun {
  /// Those whose outcomes count.
  std::vector<std::size_t> samples;
  Setting at;
  /// The objective at `at`.
  double objective = 0;
};

/// Searches one param after the other, each to the best of all its values, for several runs at a
/// time: as long as runs stand at the same setting the curves of their samples are found once.
class ParamSearch {
 public:
  /// `base` is the setting that nothing is paid for; `penalty` what each param at another value
  /// must gain; only params in `free` are moved.
  ParamSearch(const LearningSet& set, Setting base, double penalty, std::vector<std::size_t> free)
      : set_(set), base_(std::move(base)), penalty_(penalty), free_(std::move(free)) {}

  /// Takes each run to where no single param improves it any more, or through so many rounds.
  void climb(std::span<SearchRun> runs, int most_rounds) const;

  /// Takes params back to their base that gain no more than the penalty.
  void go_back(SearchRun& run) const;

  /// The objective without what params at other values cost.
  [[nodiscard]] double score_of(const SearchRun& run) const;
  /// Measures the run at its setting.
  void measure(SearchRun& run) const;

 private:
  [[nodiscard]] std::size_t changes_of(const Setting& setting) const;
  bool move_all(std::span<SearchRun> runs, std::size_t param) const;
  bool move(SearchRun& run, std::size_t param, std::span<const ParamCurve> curves) const;

  const LearningSet& set_;
  Setting base_;
  double penalty_;
  std::vector<std::size_t> free_;
};

}  // namespace oriel
