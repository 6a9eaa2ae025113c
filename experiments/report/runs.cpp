#include "experiments/report/runs.h"

#include "experiments/report/cells.h"
#include "kernel/base/text/slug.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace oriel::report {

namespace {

std::string heading_of(ExperimentPart part) {
  switch (part) {
    case ExperimentPart::sweep:
      return "Sweep";
    case ExperimentPart::ablate:
      return "Ablation";
    case ExperimentPart::compare:
      return "Comparison";
    case ExperimentPart::stability:
      return "Stability";
    case ExperimentPart::learning_curve:
      return "Learning curve";
    case ExperimentPart::learn:
      return "Learning";
  }
  return to_string(part);
}

}  // namespace

const MeasuredRun* RunGroup::baseline() const {
  const auto found =
      std::ranges::find_if(runs, [](const MeasuredRun& run) { return run.setting().is_baseline; });
  return found == runs.end() ? nullptr : &*found;
}

std::string RunGroup::title() const { return fmt::format("{} on {}", heading_of(part), set); }

std::string RunGroup::slug() const { return slug_of(to_string(part) + "-" + set); }

std::vector<RunGroup> groups_of(const std::vector<ResultRow>& rows) {
  std::vector<RunGroup> groups;
  std::map<std::pair<ExperimentPart, std::string>, std::size_t> group_of;
  std::map<std::tuple<std::size_t, std::string, std::string>, std::size_t> run_of;
  for (const ResultRow& row : rows) {
    const auto [group, is_new_group] = group_of.try_emplace({row.part, row.set}, groups.size());
    if (is_new_group) groups.push_back({row.part, row.set, {}});
    std::vector<MeasuredRun>& runs = groups[group->second].runs;
    const auto [run, is_new_run] =
        run_of.try_emplace({group->second, row.pack, row.setting.name}, runs.size());
    if (is_new_run) runs.emplace_back();
    if (row.label.empty())
      runs[run->second].mean = &row;
    else
      runs[run->second].classes.push_back(&row);
  }
  for (const RunGroup& group : groups)
    for (const MeasuredRun& run : group.runs)
      if (run.mean == nullptr) throw std::invalid_argument("a run has no row of the mean");
  return groups;
}

namespace {

std::tuple<std::size_t, std::size_t, std::size_t> counts_of(const ResultRow& row) {
  return {row.counts.true_positives, row.counts.false_positives, row.counts.false_negatives};
}

bool has_same_counts(const MeasuredRun& a, const MeasuredRun& b) {
  return counts_of(*a.mean) == counts_of(*b.mean) &&
         std::ranges::equal(a.classes, b.classes, [](const ResultRow* one, const ResultRow* other) {
           return one->label == other->label && counts_of(*one) == counts_of(*other);
         });
}

}  // namespace

bool has_effect(const RunGroup& group, const MeasuredRun& run) {
  const MeasuredRun* baseline = group.baseline();
  return baseline == nullptr || !has_same_counts(*baseline, run);
}

std::vector<std::string> variables_without_effect(const RunGroup& group) {
  std::vector<std::string> names;
  std::map<std::string, const MeasuredRun*> first_of;
  std::set<std::string> with_effect;
  const MeasuredRun* baseline = group.baseline();
  for (const MeasuredRun& run : group.runs) {
    const std::string& name = run.setting().variable;
    if (name.empty()) continue;
    const auto [first, is_new] = first_of.try_emplace(name, baseline ? baseline : &run);
    if (is_new) names.push_back(name);
    if (!has_same_counts(*first->second, run)) with_effect.insert(name);
  }
  std::erase_if(names, [&](const std::string& name) { return with_effect.contains(name); });
  return names;
}

const ResultRow* row_of(const MeasuredRun& run, const std::string& label) {
  const auto found =
      std::ranges::find(run.classes, label, [](const ResultRow* row) { return row->label; });
  return found == run.classes.end() ? nullptr : *found;
}

std::string most_changed_class(const MeasuredRun& run) {
  const ResultRow* most = nullptr;
  for (const ResultRow* row : run.classes) {
    if (!row->difference || !(std::abs(row->difference->f1) > 0)) continue;
    if (most == nullptr || std::abs(row->difference->f1) > std::abs(most->difference->f1))
      most = row;
  }
  if (most == nullptr) return {};
  return fmt::format("{} {}", most->label, difference_cell(most->difference->f1));
}

}  // namespace oriel::report
