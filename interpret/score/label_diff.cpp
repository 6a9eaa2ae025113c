#include "interpret/score/label_diff.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace oriel {

namespace {

void sort_by_id(std::vector<NamedFeature>& features) {
  std::ranges::stable_sort(features, [](const NamedFeature& p, const NamedFeature& q) {
    return std::tie(p.building, p.id) < std::tie(q.building, q.id);
  });
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

}  // namespace oriel
