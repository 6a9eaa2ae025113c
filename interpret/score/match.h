#pragma once

#include "interpret/score/score.h"

#include <map>
#include <string>
#include <vector>

namespace oriel {

/// What came of a prediction, of a true object, or of both together.
enum class MatchOutcome {
  right,          ///< the object has the predicted label
  wrong_class,    ///< the object has another label
  nothing_there,  ///< a prediction that meets no object
  not_found,      ///< an object that no prediction meets
  left_out        ///< an object that nobody can find or that is not scored, or a prediction on it
};

/// "right", "wrong class", "nothing there", "not found", "left out".
std::string to_string(MatchOutcome outcome);

/// A prediction and the object that it is compared with.
struct ObjectMatch {
  MatchOutcome outcome = MatchOutcome::right;
  /// Null: no prediction with a label meets the object.
  const Prediction* prediction = nullptr;
  /// Null: there is no object.
  const ExpectedObject* truth = nullptr;
  /// Of the grown boxes; 0 if one of them is not there.
  double iou = 0;
};

/// What score() counts: every prediction with a label once, and every object once (one that is left
/// out as often as it is met, but once), building by building: what is right, the best first; what
/// is left out because of its object; other classes; then the objects, and then the predictions,
/// that are alone. Points into `predictions` and `truth`.
std::vector<ObjectMatch> match_objects(const std::vector<Prediction>& predictions,
                                       const std::vector<ExpectedObject>& truth,
                                       const ScoreOptions& options = {});

/// The same with a feature for objects that were not found where one without a label meets them:
/// one to one, the largest IoU first, ties by the ids. It is their prediction then, and they stay
/// what they are. Sorted by building, id of the prediction (none last), and id of the object.
std::vector<ObjectMatch> match_features(const std::vector<Prediction>& predictions,
                                        const std::vector<ExpectedObject>& truth,
                                        const ScoreOptions& options = {});

/// Counts matches by building: of all that have one.
std::map<std::string, Score> score_by_building(const std::vector<ObjectMatch>& matches,
                                               const ScoreOptions& options = {});

/// Counts one of them.
void add(const ObjectMatch& match, const ScoreOptions& options, Score& score);

}  // namespace oriel
