#include "interpret/learn/label_counter.h"

#include "kernel/base/index.h"
#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <string_view>
#include <tuple>

namespace oriel {

namespace {

/// Boxes that do not overlap along x are not compared any further.
struct Slab {
  double low = 0;
  double high = 0;
  int row = -1;
};

}  // namespace

void LabelSet::add(const std::vector<std::string>& labels) {
  names_.insert(names_.end(), labels.begin(), labels.end());
  std::ranges::sort(names_);
  names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
}

void LabelSet::add(std::span<const ExpectedObject> truth) {
  std::vector<std::string> labels;
  for (const ExpectedObject& object : truth)
    if (find(object.label) == kNone) labels.push_back(object.label);
  if (!labels.empty()) add(labels);
}

int LabelSet::find(const std::string& label) const {
  const auto found = std::ranges::lower_bound(names_, label);
  if (found == names_.end() || *found != label) return kNone;
  return static_cast<int>(found - names_.begin());
}

ClassCounts& ClassCounts::operator+=(const ClassCounts& other) {
  true_positives += other.true_positives;
  false_positives += other.false_positives;
  false_negatives += other.false_negatives;
  return *this;
}

LabelCounter::LabelCounter(const Sample& sample, const LabelSet& labels,
                           const ScoreOptions& options) {
  for (const ExpectedObject& truth : sample.truth) {
    Object& object = objects_.emplace_back();
    object.label = labels.find(truth.label);
    object.is_left_out = is_left_out(truth);
    object.is_scored =
        std::ranges::find(options.not_scored, truth.label) == options.not_scored.end();
    object.is_expected = object.is_scored && !object.is_left_out;
  }
  find_pairs(sample, options);
}

/// In the order of score(): the largest overlap first, ties by the ids, then by their order.
void LabelCounter::find_pairs(const Sample& sample, const ScoreOptions& options) {
  struct Found {
    double iou = 0;
    std::string_view truth_id, row_id;
    BoxPair pair;
  };
  std::vector<Slab> slabs;
  for (int row = 0; row < static_cast<int>(sample.boxes.size()); ++row) {
    const Box box = grown(sample.boxes[at(row)], options.grow_m);
    slabs.push_back({box.min.x, box.max.x, row});
  }
  std::vector<Found> found;
  for (int object = 0; object < static_cast<int>(sample.truth.size()); ++object) {
    const ExpectedObject& truth = sample.truth[at(object)];
    const Box box = grown(truth.box, options.grow_m);
    for (const Slab& slab : slabs) {
      // What does not meet is no match unless everything is.
      if (options.min_iou > 0 && (slab.low > box.max.x || slab.high < box.min.x)) continue;
      const double iou =
          intersection_over_union(box, grown(sample.boxes[at(slab.row)], options.grow_m));
      if (iou >= options.min_iou)
        found.push_back(
            {iou, truth.id, sample.features.table.id(FeatureId{slab.row}), {object, slab.row}});
    }
  }
  std::ranges::stable_sort(found, [](const Found& p, const Found& q) {
    if (p.iou != q.iou) return p.iou > q.iou;
    return std::tie(p.truth_id, p.row_id) < std::tie(q.truth_id, q.row_id);
  });
  for (const Found& one : found) pairs_.push_back(one.pair);
}

const MatchedLabels& LabelCounter::match(std::span<const int> labels) {
  using Fate = MatchedLabels::Fate;
  matched_.row_of.assign(objects_.size(), -1);
  matched_.rows.assign(labels.size(), Fate::unlabelled);
  for (std::size_t row = 0; row < labels.size(); ++row)
    if (labels[row] != LabelSet::kNone) matched_.rows[row] = Fate::nothing;
  const auto match_all = [&](Fate as, bool needs_same) {
    for (const BoxPair& pair : pairs_) {
      const Object& object = objects_[at(pair.object)];
      if (object.is_left_out || matched_.rows[at(pair.row)] != Fate::nothing) continue;
      if (matched_.row_of[at(pair.object)] >= 0) continue;
      if (needs_same && object.label != labels[at(pair.row)]) continue;
      matched_.row_of[at(pair.object)] = pair.row;
      matched_.rows[at(pair.row)] = as;
    }
  };
  match_all(Fate::hit, true);
  for (const BoxPair& pair : pairs_)
    if (objects_[at(pair.object)].is_left_out && matched_.rows[at(pair.row)] == Fate::nothing)
      matched_.rows[at(pair.row)] = Fate::neutral;
  match_all(Fate::confused, false);
  return matched_;
}

void LabelCounter::count(std::span<const int> labels, std::span<ClassCounts> counts) {
  using Fate = MatchedLabels::Fate;
  match(labels);
  for (std::size_t row = 0; row < labels.size(); ++row) {
    if (matched_.rows[row] == Fate::hit) ++counts[at(labels[row])].true_positives;
    if (matched_.rows[row] == Fate::confused || matched_.rows[row] == Fate::nothing)
      ++counts[at(labels[row])].false_positives;
  }
  for (std::size_t i = 0; i < objects_.size(); ++i)
    if (objects_[i].is_expected && !matched_.is_hit(i))
      ++counts[at(objects_[i].label)].false_negatives;
}

}  // namespace oriel
