#include "interpret/score/label_diff.h"

#include "kernel/base/text/counted.h"
#include "kernel/base/text/json_text.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

void sort_by_id(std::vector<NamedFeature>& features) {
  std::ranges::stable_sort(features, [](const NamedFeature& p, const NamedFeature& q) {
    return std::tie(p.building, p.id) < std::tie(q.building, q.id);
  });
}

std::string label_text(const std::string& label) {
  return label.empty() ? "unknown" : printable(label);
}

/// The most frequent first; the order of names where they are equally frequent.
std::vector<const LabelDiff::Changes::value_type*> by_count(const LabelDiff& diff) {
  std::vector<const LabelDiff::Changes::value_type*> changes;
  for (const auto& change : diff.changes()) changes.push_back(&change);
  std::ranges::stable_sort(
      changes, [](const auto* p, const auto* q) { return p->second.count > q->second.count; });
  return changes;
}

std::string examples_text(const LabelDiff::LabelChange& change) {
  std::string text;
  for (const auto& [building, id] : change.examples)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", printable(building), printable(id));
  if (change.count > change.examples.size()) text += ", …";
  return text;
}

std::string rule_text(const Naming& naming) {
  return naming.rule.empty() ? "-" : printable(naming.rule);
}

std::string change_line(const LabelDiff::Changes::value_type& entry) {
  const auto& [before, after] = entry.first;
  const auto labels = fmt::format("{} -> {}", label_text(before.label), label_text(after.label));
  const auto rules = fmt::format("{} -> {}", rule_text(before), rule_text(after));
  return fmt::format("{:>7}  {:<22} {:<40} {}\n", entry.second.count, labels, rules,
                     examples_text(entry.second));
}

std::string count_line(const std::string& label, LabelDiff::Count count) {
  const auto gain = static_cast<long long>(count.after) - static_cast<long long>(count.before);
  return fmt::format("  {:<12} {:>7} -> {:>7}  {:+}\n", label_text(label), count.before,
                     count.after, gain);
}

std::string only_line(const char* which, const LabelDiff::LabelChange& change) {
  if (change.count == 0) return "";
  return fmt::format("{} only in the {} run: {}\n",
                     counted(change.count, "feature is", "features are"), which,
                     examples_text(change));
}

std::string naming_json(const Naming& naming) {
  return fmt::format(R"({{"label":{},"rule":{}}})", json_string(naming.label),
                     json_string(naming.rule));
}

std::string change_json(const LabelDiff::LabelChange& change) {
  std::string examples;
  for (const auto& [building, id] : change.examples)
    examples += fmt::format(R"({}{{"building":{},"id":{}}})", examples.empty() ? "" : ",",
                            json_string(building), json_string(id));
  return fmt::format(R"("count":{},"examples":[{}])", change.count, examples);
}

}  // namespace

void LabelDiff::note(LabelChange& change, std::string_view building, std::string_view id) const {
  if (change.count++ < most_examples_) change.examples.emplace_back(building, id);
}

void LabelDiff::add(std::string_view building, std::string_view id, const Naming& before,
                    const Naming& after) {
  ++compared_;
  ++counts_[before.label].before;
  ++counts_[after.label].after;
  if (before == after) return;
  ++(before.label == after.label ? other_rule_ : changed_);
  note(changes_[{before, after}], building, id);
}

void LabelDiff::add_only_before(const NamedFeature& feature) {
  ++counts_[feature.naming.label].before;
  note(only_before_, feature.building, feature.id);
}

void LabelDiff::add_only_after(const NamedFeature& feature) {
  ++counts_[feature.naming.label].after;
  note(only_after_, feature.building, feature.id);
}

LabelDiff diff_labels(std::vector<NamedFeature> before, std::vector<NamedFeature> after,
                      std::size_t most_examples) {
  sort_by_id(before);
  sort_by_id(after);
  LabelDiff diff(most_examples);
  auto p = before.begin();
  auto q = after.begin();
  while (p != before.end() || q != after.end()) {
    const bool is_p = p != before.end(), is_q = q != after.end();
    const auto order =
        !is_p   ? std::weak_ordering::greater
        : !is_q ? std::weak_ordering::less
                : std::weak_ordering(std::tie(p->building, p->id) <=> std::tie(q->building, q->id));
    if (order < 0) {
      diff.add_only_before(*p++);
    } else if (order > 0) {
      diff.add_only_after(*q++);
    } else {
      diff.add(p->building, p->id, p->naming, q->naming);
      ++p;
      ++q;
    }
  }
  return diff;
}

std::string to_text(const LabelDiff& diff) {
  std::string text =
      fmt::format("{} {} another label", counted_of(diff.changed(), diff.compared(), "feature"),
                  agreeing_of(diff.changed(), diff.compared(), "has", "have"));
  if (diff.renamed_rules() > 0)
    text += fmt::format(", {} the same by another rule", diff.renamed_rules());
  text += '\n';
  for (const auto& [label, count] : diff.counts())
    if (count.before != count.after) text += count_line(label, count);
  for (const auto* change : by_count(diff)) text += change_line(*change);
  text += only_line("first", diff.only_before());
  text += only_line("second", diff.only_after());
  return text;
}

std::string to_json(const LabelDiff& diff) {
  std::string classes, changes;
  for (const auto& [label, count] : diff.counts())
    classes += fmt::format(R"({}{}:{{"before":{},"after":{}}})", classes.empty() ? "" : ",",
                           json_string(label), count.before, count.after);
  for (const auto* change : by_count(diff))
    changes += fmt::format(R"({}{{"before":{},"after":{},{}}})", changes.empty() ? "" : ",",
                           naming_json(change->first.first), naming_json(change->first.second),
                           change_json(change->second));
  return fmt::format(
      R"({{"compared":{},"changed":{},"other_rule":{},"classes":{{{}}},"changes":[{}],)"
      R"("only_before":{{{}}},"only_after":{{{}}}}})",
      diff.compared(), diff.changed(), diff.renamed_rules(), classes, changes,
      change_json(diff.only_before()), change_json(diff.only_after()));
}

}  // namespace oriel
