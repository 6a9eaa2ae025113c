#include "interpret/score/match.h"

#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <tuple>

namespace oriel {

namespace {

constexpr const char* kNothing = "-";

/// A prediction and an object whose boxes meet.
struct MatchCandidate {
  double iou = 0;
  const ExpectedObject* truth = nullptr;
  const Prediction* prediction = nullptr;
};

bool is_better_match(const MatchCandidate& p, const MatchCandidate& q) {
  if (p.iou != q.iou) return p.iou > q.iou;
  return std::tie(p.truth->id, p.prediction->id) < std::tie(q.truth->id, q.prediction->id);
}

/// The best first.
std::vector<MatchCandidate> match_candidates(const std::vector<const Prediction*>& predictions,
                                             const std::vector<const ExpectedObject*>& truth,
                                             const ScoreOptions& options) {
  std::vector<MatchCandidate> candidates;
  for (const ExpectedObject* object : truth)
    for (const Prediction* prediction : predictions) {
      const double overlap = intersection_over_union(grown(object->box, options.grow_m),
                                                     grown(prediction->box, options.grow_m));
      if (overlap >= options.min_iou) candidates.push_back({overlap, object, prediction});
    }
  std::ranges::stable_sort(candidates, is_better_match);
  return candidates;
}

/// Predictions and objects of one building.
struct ContentOfBuilding {
  std::vector<const Prediction*> labelled;
  std::vector<const Prediction*> unlabelled;
  std::vector<const ExpectedObject*> truth;
};

std::map<std::string, ContentOfBuilding> content_of_buildings(
    const std::vector<Prediction>& predictions, const std::vector<ExpectedObject>& truth) {
  std::map<std::string, ContentOfBuilding> buildings;
  for (const Prediction& prediction : predictions) {
    ContentOfBuilding& content = buildings[prediction.building];
    (prediction.label.empty() ? content.unlabelled : content.labelled).push_back(&prediction);
  }
  for (const ExpectedObject& object : truth) buildings[object.building].truth.push_back(&object);
  return buildings;
}

class BuildingMatcher {
 public:
  BuildingMatcher(const ContentOfBuilding& content, const ScoreOptions& options,
                  std::vector<ObjectMatch>& matches)
      : content_(content),
        options_(options),
        matches_(matches),
        candidates_(match_candidates(content.labelled, content.truth, options)) {}

  void run() {
    match(MatchOutcome::right, [](const MatchCandidate& candidate) {
      return candidate.truth->label == candidate.prediction->label;
    });
    leave_out();
    match(MatchOutcome::wrong_class, [](const MatchCandidate&) { return true; });
    add_rest();
  }

 private:
  /// One to one, the best first, among what is not matched yet.
  template <class Wanted>
  void match(MatchOutcome outcome, Wanted is_wanted) {
    for (const MatchCandidate& candidate : candidates_) {
      if (is_left_out(*candidate.truth) || !is_wanted(candidate)) continue;
      if (is_done_.contains(candidate.truth) || is_done_.contains(candidate.prediction)) continue;
      is_done_.insert(candidate.truth);
      add(outcome, candidate);
    }
  }

  void leave_out() {
    for (const MatchCandidate& candidate : candidates_)
      if (is_left_out(*candidate.truth) && !is_done_.contains(candidate.prediction))
        add(MatchOutcome::left_out, candidate);
  }

  void add(MatchOutcome outcome, const MatchCandidate& candidate) {
    is_done_.insert(candidate.prediction);
    is_met_.insert(candidate.truth);
    matches_.push_back({outcome, candidate.prediction, candidate.truth, candidate.iou});
  }

  void add_rest() {
    for (const ExpectedObject* truth : content_.truth) {
      if (is_met_.contains(truth)) continue;
      const bool is_missed = !is_left_out(*truth) && is_scored(truth->label, options_);
      matches_.push_back(
          {is_missed ? MatchOutcome::not_found : MatchOutcome::left_out, nullptr, truth, 0});
    }
    for (const Prediction* prediction : content_.labelled)
      if (!is_done_.contains(prediction))
        matches_.push_back({MatchOutcome::nothing_there, prediction, nullptr, 0});
  }

  const ContentOfBuilding& content_;
  const ScoreOptions& options_;
  std::vector<ObjectMatch>& matches_;
  std::vector<MatchCandidate> candidates_;
  std::set<const void*> is_done_;
  std::set<const ExpectedObject*> is_met_;
};

/// Gives missed objects the features that are there without a label.
void add_unlabelled(const ContentOfBuilding& content, const ScoreOptions& options,
                    std::span<ObjectMatch> matches) {
  std::map<const ExpectedObject*, ObjectMatch*> missed;
  std::vector<const ExpectedObject*> truth;
  for (ObjectMatch& match : matches)
    if (match.outcome == MatchOutcome::not_found) {
      missed[match.truth] = &match;
      truth.push_back(match.truth);
    }
  std::set<const Prediction*> is_taken;
  for (const MatchCandidate& candidate : match_candidates(content.unlabelled, truth, options)) {
    ObjectMatch& match = *missed[candidate.truth];
    if (match.prediction || !is_taken.insert(candidate.prediction).second) continue;
    match.prediction = candidate.prediction;
    match.iou = candidate.iou;
  }
}

const std::string& building_of(const ObjectMatch& match) {
  return match.truth ? match.truth->building : match.prediction->building;
}

/// Sorts by building and ids, with those without a prediction at the end.
bool is_before(const ObjectMatch& p, const ObjectMatch& q) {
  const auto key = [](const ObjectMatch& match) {
    return std::tuple<std::string_view, bool, std::string_view, std::string_view>(
        building_of(match), !match.prediction,
        match.prediction ? std::string_view(match.prediction->id) : std::string_view(),
        match.truth ? std::string_view(match.truth->id) : std::string_view());
  };
  return key(p) < key(q);
}

Miss miss_of(const ObjectMatch& match) {
  Miss miss;
  miss.building = building_of(match);
  if (match.truth) miss.truth_id = match.truth->id, miss.truth_label = match.truth->label;
  if (match.prediction) {
    miss.prediction_id = match.prediction->id;
    miss.prediction_label = match.prediction->label;
  }
  miss.iou = match.iou;
  return miss;
}

}  // namespace

std::string to_string(MatchOutcome outcome) {
  switch (outcome) {
    case MatchOutcome::right:
      return "right";
    case MatchOutcome::wrong_class:
      return "wrong class";
    case MatchOutcome::nothing_there:
      return "nothing there";
    case MatchOutcome::not_found:
      return "not found";
    case MatchOutcome::left_out:
      return "left out";
  }
  return {};
}

std::vector<ObjectMatch> match_objects(const std::vector<Prediction>& predictions,
                                       const std::vector<ExpectedObject>& truth,
                                       const ScoreOptions& options) {
  std::vector<ObjectMatch> matches;
  for (const auto& [building, content] : content_of_buildings(predictions, truth))
    BuildingMatcher(content, options, matches).run();
  return matches;
}

std::vector<ObjectMatch> match_features(const std::vector<Prediction>& predictions,
                                        const std::vector<ExpectedObject>& truth,
                                        const ScoreOptions& options) {
  std::vector<ObjectMatch> matches;
  for (const auto& [building, content] : content_of_buildings(predictions, truth)) {
    const std::size_t before = matches.size();
    BuildingMatcher(content, options, matches).run();
    add_unlabelled(content, options, std::span(matches).subspan(before));
  }
  std::ranges::stable_sort(matches, is_before);
  return matches;
}

std::map<std::string, Score> score_by_building(const std::vector<ObjectMatch>& matches,
                                               const ScoreOptions& options) {
  std::map<std::string, Score> scores;
  for (const ObjectMatch& match : matches) add(match, options, scores[building_of(match)]);
  return scores;
}

void add(const ObjectMatch& match, const ScoreOptions& options, Score& score) {
  const auto count = [&] {
    ++score.confusion[{match.truth ? match.truth->label : kNothing,
                       match.prediction ? match.prediction->label : kNothing}];
  };
  switch (match.outcome) {
    case MatchOutcome::right:
      ++score.classes[match.truth->label].true_positives;
      return count();
    case MatchOutcome::left_out:
      if (!match.prediction) return;
      ++score.neutral;
      score.left_out.emplace_back(match.prediction->building, match.prediction->id);
      return;
    case MatchOutcome::wrong_class:
      ++score.classes[match.prediction->label].false_positives;
      if (is_scored(match.truth->label, options))
        ++score.classes[match.truth->label].false_negatives;
      break;
    case MatchOutcome::not_found:
      ++score.classes[match.truth->label].false_negatives;
      break;
    case MatchOutcome::nothing_there:
      ++score.classes[match.prediction->label].false_positives;
      break;
  }
  count();
  score.misses.push_back(miss_of(match));
}

}  // namespace oriel
