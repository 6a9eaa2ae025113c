#include "interpret/learn/objective.h"

#include "kernel/base/index.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace oriel {

namespace {

constexpr const char* kNothing = "-";

double f1_of_counts(const ClassCounts& counts) {
  const double all = 2.0 * counts.true_positives + counts.false_positives + counts.false_negatives;
  return all > 0 ? 2.0 * counts.true_positives / all : 0;
}

bool is_in_truth(const ClassCounts& counts) {
  return counts.true_positives + counts.false_negatives > 0;
}

std::string_view trimmed_cell(std::string_view cell) {
  while (!cell.empty() && cell.front() == ' ') cell.remove_prefix(1);
  while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\r')) cell.remove_suffix(1);
  return cell;
}

std::vector<std::string_view> cells_of_line(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed_cell(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

Objective Objective::f1_of(std::string label) {
  Objective objective;
  objective.label_ = std::move(label);
  return objective;
}

Objective Objective::least_cost(Costs costs) {
  Objective objective;
  objective.costs_ = std::move(costs);
  return objective;
}

std::string Objective::name() const {
  if (costs_) return "-cost";
  return label_.empty() ? "macro-F1" : "F1 of " + label_;
}

double Objective::cost_of(const LabelCounter& counter, std::span<const int> labels,
                          const LabelSet& set) const {
  if (!costs_) return 0;
  using Fate = MatchedLabels::Fate;
  const MatchedLabels& matched = counter.last();
  double sum = 0;
  const auto add = [&](const std::string& truth, const std::string& predicted) {
    if (const auto cost = costs_->find({truth, predicted}); cost != costs_->end())
      sum += cost->second;
  };
  for (std::size_t object = 0; object < matched.row_of.size(); ++object) {
    const int row = matched.row_of[object];
    if (row < 0 && !counter.is_expected(object)) continue;
    add(set.names()[at(counter.label_of(object))],
        row < 0 ? kNothing : set.names()[at(labels[at(row)])]);
  }
  for (std::size_t row = 0; row < labels.size(); ++row)
    if (matched.rows[row] == Fate::nothing) add(kNothing, set.names()[at(labels[row])]);
  return sum;
}

double Objective::value(std::span<const ClassCounts> counts, double cost,
                        const LabelSet& set) const {
  double sum = 0;
  std::size_t classes = 0, expected = 0;
  for (std::size_t label = 0; label < counts.size(); ++label) {
    if (!label_.empty() && set.names()[label] != label_) continue;
    expected += counts[label].true_positives + counts[label].false_negatives;
    if (!is_in_truth(counts[label])) continue;
    sum += f1_of_counts(counts[label]);
    ++classes;
  }
  if (costs_) return expected == 0 ? 0 : -cost / static_cast<double>(expected);
  return classes == 0 ? 0 : sum / static_cast<double>(classes);
}

Checked<Objective::Costs> read_costs(std::string_view text, const std::string& file) {
  Checked<Objective::Costs> result;
  Objective::Costs costs;
  int number = 0;
  const auto refuse = [&](Code code, std::string sentence) {
    Issue issue;
    issue.code = code;
    issue.sentence = std::move(sentence);
    issue.place.file = file;
    issue.place.line = number;
    result.issues.push_back(std::move(issue));
  };
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed_cell(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const auto cells = cells_of_line(line);
    double cost = 0;
    const bool is_number =
        cells.size() == 3 &&
        std::from_chars(cells[2].data(), cells[2].data() + cells[2].size(), cost).ptr ==
            cells[2].data() + cells[2].size() &&
        !cells[2].empty();
    if (cells.size() == 3 && number == 1 && !is_number && cells[2] == "cost") continue;  // header
    if (!is_number || cells[0].empty() || cells[1].empty())
      refuse(Code::R211, fmt::format("'{}' is no cost; expected truth,predicted,cost such as "
                                     "'door,window,5', '-' for nothing",
                                     line));
    else if (!(cost >= 0) || !std::isfinite(cost))
      refuse(Code::R212, fmt::format("a cost is 0 or more, not '{}'", cells[2]));
    else
      costs[{std::string(cells[0]), std::string(cells[1])}] = cost;
  }
  if (result.issues.empty()) result.value = std::move(costs);
  return result;
}

}  // namespace oriel
