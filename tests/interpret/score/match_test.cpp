#include "interpret/score/match.h"

#include <algorithm>
#include <set>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace oriel;

namespace {

/// A box of width 1, depth 0.2 and height 1 at x.
Box pane_on_wall(double x) { return {{x, 0, 1}, {x + 1, 0.2, 2}}; }

ExpectedObject true_pane(const std::string& id, const std::string& label, double x) {
  return {"house", id, label, "", pane_on_wall(x), true};
}

Prediction found_pane(const std::string& id, const std::string& label, double x) {
  return {"house", id, label, pane_on_wall(x)};
}

/// Panes of any class along a wall, some of them unlabelled, some without faces.
std::pair<std::vector<Prediction>, std::vector<ExpectedObject>> random_wall() {
  std::vector<Prediction> predictions;
  std::vector<ExpectedObject> truth;
  const auto x = [] { return *rc::gen::inRange(0, 40) * 0.25; };
  const auto label = [](bool may_be_wall) {
    return *rc::gen::element<std::string>("window", "door", may_be_wall ? "wall" : "");
  };
  for (int i = *rc::gen::inRange(0, 12); i > 0; --i)
    predictions.push_back(found_pane("p" + std::to_string(i), label(false), x()));
  for (int i = *rc::gen::inRange(0, 12); i > 0; --i) {
    truth.push_back(true_pane("t" + std::to_string(i), label(true), x()));
    truth.back().has_faces = *rc::gen::inRange(0, 5) != 0;
  }
  return {predictions, truth};
}

MatchOutcome only_outcome(const std::vector<Prediction>& predictions,
                          const std::vector<ExpectedObject>& truth) {
  const auto matches = match_objects(predictions, truth);
  REQUIRE(matches.size() == 1);
  return matches[0].outcome;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("a match says what came of a feature and of an object") {
    const ExpectedObject window = true_pane("t", "window", 0);
    CHECK(only_outcome({found_pane("p", "window", 0.1)}, {window}) == MatchOutcome::right);
    CHECK(only_outcome({found_pane("p", "door", 0.1)}, {window}) == MatchOutcome::wrong_class);
    CHECK(only_outcome({found_pane("p", "", 0.1)}, {window}) == MatchOutcome::not_found);
    CHECK(only_outcome({}, {window}) == MatchOutcome::not_found);
    CHECK(only_outcome({found_pane("p", "window", 0)}, {}) == MatchOutcome::nothing_there);
    CHECK(only_outcome({}, {true_pane("t", "wall", 0)}) == MatchOutcome::left_out);
    ExpectedObject hidden = window;
    hidden.has_faces = false;
    CHECK(only_outcome({}, {hidden}) == MatchOutcome::left_out);
    CHECK(only_outcome({found_pane("p", "window", 0)}, {hidden}) == MatchOutcome::left_out);
  }

  TEST_CASE("an object that was not found names the feature without a label that is there") {
    const std::vector<Prediction> predictions = {
        found_pane("far", "", 5), found_pane("near", "", 0.2), found_pane("nearer", "", 0.1)};
    const std::vector<ExpectedObject> truth = {true_pane("t", "window", 0)};
    const auto matches = match_features(predictions, truth);
    REQUIRE(matches.size() == 1);
    CHECK(matches[0].outcome == MatchOutcome::not_found);
    CHECK(matches[0].prediction == &predictions[2]);
    CHECK(matches[0].iou > 0.5);
  }

  TEST_CASE("what is matched is each labelled feature once and each object at least once") {
    rc::check([] {
      const auto [predictions, truth] = random_wall();
      std::multiset<const Prediction*> labelled;
      std::set<const ExpectedObject*> objects;
      for (const ObjectMatch& match : match_objects(predictions, truth)) {
        if (match.prediction) labelled.insert(match.prediction);
        if (match.truth) objects.insert(match.truth);
        RC_ASSERT((match.iou > 0) == (match.prediction && match.truth));
      }
      std::size_t count = 0;
      for (const Prediction& prediction : predictions) {
        count += prediction.label.empty() ? 0U : 1U;
        RC_ASSERT(labelled.count(&prediction) == (prediction.label.empty() ? 0U : 1U));
      }
      RC_ASSERT(labelled.size() == count);
      RC_ASSERT(objects.size() == truth.size());
    });
  }

  TEST_CASE("features without a label change no outcome") {
    rc::check([] {
      const auto [predictions, truth] = random_wall();
      const auto count = [](const std::vector<ObjectMatch>& matches) {
        std::multiset<MatchOutcome> outcomes;
        for (const ObjectMatch& match : matches) outcomes.insert(match.outcome);
        return outcomes;
      };
      RC_ASSERT(count(match_objects(predictions, truth)) ==
                count(match_features(predictions, truth)));
      const Score score = oriel::score(predictions, truth);
      const auto outcomes = count(match_objects(predictions, truth));
      std::size_t right = 0;
      for (const auto& [label, counts] : score.classes) right += counts.true_positives;
      RC_ASSERT(outcomes.count(MatchOutcome::right) == right);
      RC_ASSERT(score.misses.size() == outcomes.count(MatchOutcome::wrong_class) +
                                           outcomes.count(MatchOutcome::not_found) +
                                           outcomes.count(MatchOutcome::nothing_there));
    });
  }
}
