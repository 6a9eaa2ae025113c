#pragma once

#include "kernel/base/issue.h"

#include <cstddef>
#include <string>
#include <vector>

namespace oriel::cli {

/// Findings about the buildings of a city, for a reader: those of one building as they are, those
/// of several summed by code. Of each code it keeps no more than the findings of one building.
class IssueSums {
 public:
  /// True if the finding, an error or a warning about a building, is kept for `take`; else it is to
  /// be reported now: a note, a finding about no building, and the first errors of a code.
  bool keep(const Issue& issue);

  /// What is to be reported of all that was kept, in the order in which the codes came first: the
  /// findings where they are of one building; else one with their number and the first of them,
  /// `E309 in 3 buildings (4 times), for example B: 2 facets ...`.
  [[nodiscard]] std::vector<Issue> so_far() const;

  /// The same; then nothing is kept.
  std::vector<Issue> take();

 private:
  struct Sum {
    Severity severity = Severity::warning;
    Code code = Code::none;
    std::vector<Issue> findings;  ///< of the first building
    std::size_t count = 0;
    std::size_t buildings = 0;
    std::string last_building;
  };
  [[nodiscard]] Sum& sum_of(const Issue& issue);
  static Issue summed(const Sum& sum);

  std::vector<Sum> sums_;
};

}  // namespace oriel::cli
