#pragma once

#include "interpret/learn/sample.h"
#include "interpret/score/score.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// The labels that are compared, sorted by name: those of a pack and those of the truth.
class LabelSet {
 public:
  static constexpr int kNone = -1;

  void add(const std::vector<std::string>& labels);
  void add(std::span<const ExpectedObject> truth);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] std::size_t size() const { return names_.size(); }
  /// The position of a label in names(), or kNone.
  [[nodiscard]] int find(const std::string& label) const;

 private:
  std::vector<std::string> names_;
};

/// How often a class was found, in little room.
struct ClassCounts {
  std::uint32_t true_positives = 0;
  std::uint32_t false_positives = 0;
  std::uint32_t false_negatives = 0;

  [[nodiscard]] bool is_nothing() const {
    return true_positives == 0 && false_positives == 0 && false_negatives == 0;
  }
  [[nodiscard]] ClassScore score() const {
    return {true_positives, false_positives, false_negatives};
  }
  ClassCounts& operator+=(const ClassCounts& other);
  friend bool operator==(const ClassCounts&, const ClassCounts&) = default;
};

/// What became of labels when they were compared with the truth of their building.
struct MatchedLabels {
  /// By object of the truth: the row that it was matched with, or -1.
  std::vector<int> row_of;
  enum class Fate : std::uint8_t { unlabelled, hit, neutral, confused, nothing };
  std::vector<Fate> rows;

  [[nodiscard]] bool is_hit(std::size_t object) const {
    const int row = row_of[object];
    return row >= 0 && rows[static_cast<std::size_t>(row)] == Fate::hit;
  }
};

/// Compares labels of one sample with its truth, as score() does, as often as labels change: boxes
/// are compared once. The set must have all labels of the truth and outlive it, as must the sample.
class LabelCounter {
 public:
  LabelCounter(const Sample& sample, const LabelSet& labels, const ScoreOptions& options);

  /// `labels` by row, as positions in the set or kNone. Valid until the next call.
  const MatchedLabels& match(std::span<const int> labels);

  /// Adds what match() says to counts, by label of the set. The same as score() of these labels.
  void count(std::span<const int> labels, std::span<ClassCounts> counts);
  /// What match() or count() found last.
  [[nodiscard]] const MatchedLabels& last() const { return matched_; }

  /// Whether the object would be a miss if nothing were found there.
  [[nodiscard]] bool is_expected(std::size_t object) const { return objects_[object].is_expected; }
  [[nodiscard]] int label_of(std::size_t object) const { return objects_[object].label; }
  [[nodiscard]] std::size_t objects() const { return objects_.size(); }

 private:
  struct Object {
    int label = LabelSet::kNone;
    bool is_left_out = false;
    /// Scored and not left out.
    bool is_expected = false;
    bool is_scored = false;
  };
  /// An object and a row whose boxes meet; the best first.
  struct BoxPair {
    int object = -1;
    int row = -1;
  };
  void find_pairs(const Sample& sample, const ScoreOptions& options);

  std::vector<Object> objects_;
  std::vector<BoxPair> pairs_;
  MatchedLabels matched_;
};

}  // namespace oriel
