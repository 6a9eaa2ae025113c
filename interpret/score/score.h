#pragma once

#include "model/vec3.h"

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// Something a labelling found.
struct Prediction {
  std::string building;
  std::string id;
  std::string label;
  /// In the input's coordinates.
  Box box;
  /// How sure the labelling is, 0…1.
  double score = 0;
  /// The rule that decided, and the label that came second; empty where nobody says.
  std::string rule = {};
  std::string runner_up = {};
  /// For people: feature_names().
  std::string name = {};
};

/// Something that is there.
struct ExpectedObject {
  std::string building;
  std::string id;
  std::string label;
  /// "installation" makes an object of label `other` one that nobody named.
  std::string subclass;
  /// The feature's box where the truth has one (pane and niche), else the object's.
  Box box;
  /// False for objects that are not in the stripped model.
  bool has_faces = true;
};

/// Nobody can find it, or nobody named it.
bool is_left_out(const ExpectedObject& object);

struct ScoreOptions {
  /// Boxes are grown by this on every side before they are compared.
  double grow_m = 0.05;
  /// Intersection over union from which on two boxes match.
  double min_iou = 0.5;
  /// Labels of the truth that no feature is expected to have.
  std::vector<std::string> not_scored = {"wall", "roof", "ground", "other"};
};

/// True of labels that features are expected to have where the truth has them.
bool is_scored(const std::string& label, const ScoreOptions& options);

/// How a class was found. Ratios without a denominator are NaN.
struct ClassScore {
  std::size_t true_positives = 0;
  std::size_t false_positives = 0;
  std::size_t false_negatives = 0;

  ClassScore& operator+=(const ClassScore& other);
  [[nodiscard]] double precision() const;
  [[nodiscard]] double recall() const;
  [[nodiscard]] double f1() const;
};

/// One thing that went wrong: an object that was not found (no prediction), a prediction of nothing
/// (no object), or an object that was called something else.
struct Miss {
  std::string building;
  std::string truth_id;
  std::string truth_label;
  std::string prediction_id;
  std::string prediction_label;
  double iou = 0;
};

/// The miss with its words as people may see them (kernel/base/text/printable.h).
Miss printable(const Miss& miss);

struct Score {
  /// By label: those of the truth that are scored, and those that were predicted.
  std::map<std::string, ClassScore> classes;
  /// (label of the truth, predicted label) -> count; "-" stands for nothing there, nothing found.
  std::map<std::pair<std::string, std::string>, std::size_t> confusion;
  /// Sorted by building, label and id.
  std::vector<Miss> misses;
  /// Predictions on objects that are left out.
  std::size_t neutral = 0;
  /// Building and id of these.
  std::vector<std::pair<std::string, std::string>> left_out;

  /// The mean F1 of the classes that the truth has; NaN if it has none.
  [[nodiscard]] double macro_f1() const;
};

/// Compares predictions with the truth of the same buildings. A prediction matches an object of the
/// same building and label whose grown box has IoU >= min_iou; one to one, the largest IoU first,
/// ties by the ids. Objects without faces, and `other` installations, are left out; a prediction
/// that meets one of them (IoU >= min_iou) and nothing else is left out, too. What remains is
/// wrong; where it meets an object of another label the confusion table says which. Predictions
/// without a label are not looked at.
Score score(const std::vector<Prediction>& predictions, const std::vector<ExpectedObject>& truth,
            const ScoreOptions& options = {});

/// The same, building by building: of all that have truth or predictions.
std::map<std::string, Score> score_by_building(const std::vector<Prediction>& predictions,
                                               const std::vector<ExpectedObject>& truth,
                                               const ScoreOptions& options = {});

/// What all buildings come to together.
Score total(const std::map<std::string, Score>& buildings);

/// A table for a terminal: a line a class, the macro-F1, what was taken for what, and the misses:
/// no more than `max_misses`, then how many more there are.
std::string to_text(const Score& score,
                    std::size_t max_misses = std::numeric_limits<std::size_t>::max());

/// The same as one JSON object on one line (docs/formats.md). `further` are members of it as JSON,
/// as area_json and intervals_json give them.
std::string to_json(const Score& score, const std::vector<std::string>& further = {});

}  // namespace oriel
