#pragma once

#include "interpret/learn/label_counter.h"
#include "kernel/base/issue.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// What is made as large as possible when rules are learnt.
class Objective {
 public:
  /// What a label costs: (label of the truth, label that was given) -> cost; "-" stands for nothing
  /// there, nothing found.
  using Costs = std::map<std::pair<std::string, std::string>, double>;

  /// The mean F1 of the classes that the truth has.
  static Objective macro_f1() { return {}; }
  /// F1 of one class.
  static Objective f1_of(std::string label);
  /// The mean cost of a true object that is expected, taken from 0. What is not among the costs
  /// costs nothing.
  static Objective least_cost(Costs costs);

  /// "macro_f1", "f1 of door", "-cost".
  [[nodiscard]] std::string name() const;
  [[nodiscard]] const std::string& label() const { return label_; }
  [[nodiscard]] bool has_costs() const { return costs_.has_value(); }

  /// The cost of what became of labels; 0 without costs.
  [[nodiscard]] double cost_of(const LabelCounter& counter, std::span<const int> labels,
                               const LabelSet& set) const;
  /// The value of counts by label of the set; 0 where nothing can be said.
  [[nodiscard]] double value(std::span<const ClassCounts> counts, double cost,
                             const LabelSet& set) const;

 private:
  std::string label_;
  std::optional<Costs> costs_;
};

/// Reads a matrix of costs: lines of `truth,predicted,cost`, blank ones and those that begin with
/// `#` are skipped. R211 with the line for what is none; R212 for a cost below 0.
Checked<Objective::Costs> read_costs(std::string_view text, const std::string& file);

}  // namespace oriel
