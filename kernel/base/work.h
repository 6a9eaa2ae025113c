#pragma once

#include "kernel/base/issue.h"

#include <cstdint>
#include <limits>
#include <string>

namespace oriel {

/// Steps that one stage may take on one building unless something else is asked for: more than
/// real buildings need whose cuts can be found, and about half a second.
inline constexpr std::int64_t kWorkBudget = 40'000'000;

/// The work of one stage on one building. A step is a look at one half-edge, corner or feature in
/// an inner loop. Steps are counted, never timed: a stage stops at the same place on every machine.
class Work {
 public:
  /// Of a stage that is never stopped.
  Work() = default;
  explicit Work(std::int64_t budget) : budget_(budget) {}

  void add(std::int64_t steps) { done_ += steps; }
  /// Adds what flat loops do that only read or write a number for each item: a quarter of a step.
  void add_flat(std::int64_t items) { done_ += items / 4; }
  [[nodiscard]] bool is_used_up() const { return done_ > budget_; }
  [[nodiscard]] std::int64_t done() const { return done_; }
  [[nodiscard]] std::int64_t budget() const { return budget_; }

 private:
  std::int64_t done_ = 0;
  std::int64_t budget_ = std::numeric_limits<std::int64_t>::max();
};

/// Warning E502: what used up its budget ("segmenting"), and what is missing or whole for it.
Issue used_up(const std::string& building, std::int64_t budget, const std::string& stage,
              const std::string& outcome);

}  // namespace oriel
