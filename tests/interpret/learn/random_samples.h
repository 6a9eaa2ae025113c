#pragma once

#include "interpret/learn/sample.h"
#include "tests/interpret/random_scene.h"

#include <string>
#include <utility>
#include <vector>

namespace oriel::test {

/// A building of random features in boxes of which many meet, and objects that are there: most of
/// them where a feature is.
inline Sample random_sample(std::uint64_t seed, int features) {
  Draws draws(seed + 77);
  const Scene scene = random_scene(seed, features);
  Sample sample{{scene.table(), scene.graph()}, {}, {}};
  for (int i = 0; i < features; ++i) {
    const Vec3 corner{draws.between(0, 8, 8), draws.between(0, 2, 2), draws.between(0, 6, 6)};
    sample.boxes.push_back({corner, corner + Vec3{1, draws.between(0.2, 1, 2), 1}});
  }
  const char* labels[] = {"window", "door", "window", "dormer", "other", "wall", "balcony"};
  for (int i = 0; i < features; ++i) {
    ExpectedObject object;
    object.building = "house";
    object.id = fmt::format("o{}", draws.below(features));  // some twice
    object.label = labels[draws.below(7)];
    if (draws.below(3) == 0) object.subclass = "installation";
    object.box = sample.boxes[static_cast<std::size_t>(draws.below(features))];
    if (draws.below(2) == 0) object.box.max.x += draws.between(0, 1, 4);
    object.has_faces = draws.below(6) > 0;
    sample.truth.push_back(std::move(object));
  }
  return sample;
}

/// What score() reads of labels of a sample; empty for none.
inline std::vector<Prediction> predictions_of(const Sample& sample,
                                              const std::vector<std::string>& labels) {
  std::vector<Prediction> predictions;
  for (std::size_t row = 0; row < labels.size(); ++row) {
    Prediction prediction;
    prediction.building = "house";
    prediction.id = sample.features.table.id(FeatureId{static_cast<int>(row)});
    prediction.label = labels[row];
    prediction.box = sample.boxes[row];
    predictions.push_back(std::move(prediction));
  }
  return predictions;
}

/// The labels that interpret() gives, "" for none.
inline std::vector<std::string> labels_of(const RuleBase& rules, const Sample& sample) {
  std::vector<std::string> labels;
  for (const Verdict& verdict :
       interpret(rules, sample.features.table, sample.features.graph).verdicts)
    labels.push_back(verdict.label.text());
  return labels;
}

/// Buildings of which is true what `truth` says, each feature in a box apart from the others.
inline std::vector<Sample> samples_labelled_by(const RuleBase& truth, int count,
                                               int features = 20) {
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    Sample sample = random_sample(static_cast<std::uint64_t>(i), features);
    sample.truth.clear();
    const auto labels = labels_of(truth, sample);
    for (std::size_t row = 0; row < labels.size(); ++row) {
      const auto x = static_cast<double>(3 * row);
      sample.boxes[row] = {{x, 0, 0}, {x + 1, 1, 1}};
      if (labels[row].empty()) continue;
      ExpectedObject object;
      object.building = "house";
      object.id = fmt::format("o{}", row);
      object.label = labels[row];
      object.box = sample.boxes[row];
      sample.truth.push_back(std::move(object));
    }
    samples.push_back(std::move(sample));
  }
  return samples;
}

inline bool is_same(const std::map<std::string, ClassScore>& p,
                    const std::map<std::string, ClassScore>& q) {
  return std::ranges::equal(p, q, [](const auto& a, const auto& b) {
    return a.first == b.first && a.second.true_positives == b.second.true_positives &&
           a.second.false_positives == b.second.false_positives &&
           a.second.false_negatives == b.second.false_negatives;
  });
}

}  // namespace oriel::test
