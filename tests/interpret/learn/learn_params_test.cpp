#include "interpret/learn/learn_params.h"

#include "interpret/learn/ask.h"
#include "interpret/learn/learning_set.h"
#include "interpret/learn/learnt_pack.h"
#include "interpret/learn/propose.h"
#include "interpret/learn/search/param_fit.h"
#include "interpret/learn/search/plateau.h"
#include "tests/interpret/learn/random_samples.h"

#include <functional>
#include <numeric>
#include <thread>

#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// Windows above a sill, doors below it, of a width that others of the facade share.
const std::string kSillPack =
    "schema: oriel/1\n"
    "pack: {name: sills, version: 1.0.0}\n"
    "params:\n"
    "  sill: {value: 1 m, range: 0.2 m .. 4 m}\n"
    "  widest: {value: 3 m, range: 1 m .. 6 m}\n"
    "  near: {value: 0.5 m, range: 0.1 m .. 2 m}\n"
    "  unused: {value: 1 m, range: 0 m .. 2 m}\n"
    "classes: {window: {}, door: {}}\n"
    "rules:\n"
    "  - id: window.w\n"
    "    label: window\n"
    "    require: [width <= $widest and base_height > $sill]\n"
    "    unless: [count(same_facade where abs(along - self.along) <= $near) >= 3]\n"
    "  - {id: door.d, label: door, require: 'width <= $widest and base_height <= $sill'}\n";

RuleBase sills() { return load_pack(kSillPack, "sills.yaml").value.value(); }

RuleBase with(const RuleBase& rules, std::vector<ParamValue> values) {
  return with_params(rules, std::span<const ParamValue>(values)).value.value();
}

Learnt learnt_from(const RuleBase& rules, const std::vector<Sample>& samples,
                   const LearnOptions& options = {}) {
  const auto learnt = learn_params(rules, samples, folds_of(samples.size(), 4, 1), options);
  REQUIRE(learnt.value);
  return *learnt.value;
}

/// The findings of that severity, a line each.
std::string faults(const RuleBase& rules, const std::vector<Sample>& samples,
                   const LearnOptions& options, Severity severity = Severity::error) {
  std::string text;
  for (const Issue& issue :
       learn_params(rules, samples, folds_of(samples.size(), 2, 1), options).issues)
    if (issue.severity == severity) text += to_string(issue) + "\n";
  return text;
}

}  // namespace

TEST_SUITE("interpret/learn") {
  TEST_CASE("a curve says what a pack at each of its values comes to") {
    const RuleBase rules = sills();
    CHECK(rc::check([&] {
      const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
      const std::vector<Sample> samples{random_sample(seed, 15)};
      const ForEachShare for_each = for_each_in_turn;
      const LearningSet set(rules, samples, Objective::macro_f1(), for_each);
      RC_ASSERT(set.params().size() == 3U);
      const std::size_t only[] = {0};
      for (const std::size_t param : set.params()) {
        const ParamCurve curve = set.curves(set.setting(), param, only).front();
        RC_ASSERT(curve.at_value == set.outcomes(set.setting(), only).front());
        const auto [low, high] = *set.pack().params[param].range;
        for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
          const double from = curve.pieces[i].from;
          const double to = i + 1 < curve.pieces.size() ? curve.pieces[i + 1].from : high;
          for (const double share : {0.01, 0.37, 0.99}) {
            Setting at = set.setting();
            at[param] = from + (to - from) * share;
            const auto found = set.outcomes(at, only).front();
            // A value may hit a place where something turns, which belongs to neither side.
            Setting beside = at;
            beside[param] += 1e-7 * (high - low);
            RC_ASSERT(found == curve.pieces[i].outcome ||
                      set.outcomes(beside, only).front() == curve.pieces[i].outcome);
          }
        }
      }
    }));
  }

  TEST_CASE("a set that was asked before says what a fresh one says") {
    const RuleBase rules = sills();
    CHECK(rc::check([&] {
      const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
      const std::vector<Sample> samples{random_sample(seed, 12), random_sample(seed + 1, 9)};
      const ForEachShare for_each = for_each_in_turn;
      const LearningSet asked(rules, samples, Objective::macro_f1(), for_each);
      const SamplePart all = all_samples(samples.size());
      const auto& params = asked.params();
      for (int round = 0; round < 6; ++round) {
        Setting at = asked.setting();
        at[params[0]] = 0.5 * *rc::gen::inRange(1, 4);
        at[params[1]] = 1.0 + *rc::gen::inRange(0, 3);
        const std::size_t param = params[static_cast<std::size_t>(*rc::gen::inRange(0, 2))];
        const LearningSet fresh(rules, samples, Objective::macro_f1(), for_each);
        RC_ASSERT(asked.outcomes(at, all) == fresh.outcomes(at, all));
        const auto of_asked = asked.curves(at, param, all), of_fresh = fresh.curves(at, param, all);
        for (const std::size_t sample : all) {
          RC_ASSERT(of_asked[sample].at_value == of_fresh[sample].at_value);
          RC_ASSERT(of_asked[sample].pieces.size() == of_fresh[sample].pieces.size());
          for (std::size_t i = 0; i < of_asked[sample].pieces.size(); ++i) {
            RC_ASSERT(of_asked[sample].pieces[i].from == of_fresh[sample].pieces[i].from);
            RC_ASSERT(of_asked[sample].pieces[i].outcome == of_fresh[sample].pieces[i].outcome);
          }
        }
      }
    }));
  }

  TEST_CASE("a param that was moved comes back and nothing else is changed") {
    const RuleBase rules = sills();
    const auto samples = samples_labelled_by(rules, 12);
    const Learnt learnt = learnt_from(with(rules, {{"sill", 3.0}}), samples);
    CHECK(learnt.held_out_before < 0.9);
    CHECK(learnt.held_out_after > 0.99);
    REQUIRE(learnt.params.size() == 1);
    CHECK(learnt.params[0].value.name == "sill");
    CHECK(std::abs(learnt.params[0].value.value - 1) < 0.2);
    CHECK(learnt.params[0].folds == 4);
    CHECK(learnt.params[0].interval.low > 0);
    CHECK(learnt.reason.empty());
  }

  TEST_CASE("a pack that is right stays as it is") {
    const RuleBase rules = sills();
    const Learnt learnt = learnt_from(rules, samples_labelled_by(rules, 8));
    CHECK(learnt.params.empty());
    CHECK(learnt.reason == "no change of a param gains more than its penalty");
    CHECK(learnt.held_out_after == 1);
    const std::string text = learnt_pack(learnt, rules, "learnt", "sills.yaml");
    CHECK(text.find("# Nothing is changed: no change of a param") != std::string::npos);
    CHECK(text.find("\nparams") == std::string::npos);
  }

  TEST_CASE("what was learnt is never worse on held-out folds than the pack") {
    const RuleBase rules = sills();
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      std::vector<Sample> samples;
      for (std::uint64_t i = 0; i < 6; ++i) samples.push_back(random_sample(seed * 10 + i, 12));
      const Learnt learnt = learnt_from(rules, samples);
      CHECK(learnt.held_out_after >= learnt.held_out_before);
      CHECK(learnt.params.empty() == !learnt.reason.empty());
    }
  }

  TEST_CASE("what a fold is measured with does not depend on its truth") {
    const RuleBase rules = with(sills(), {{"sill", 3.0}});
    auto samples = samples_labelled_by(sills(), 8);
    const auto parts = folds_of(samples.size(), 4, 1);
    const auto learnt = learn_params(rules, samples, parts, {}).value.value();
    REQUIRE(learnt.learnt_without.size() == 4);
    CHECK(!learnt.learnt_without[0].empty());
    for (const std::size_t i : parts[0]) samples[i].truth.resize(samples[i].truth.size() / 2);
    const auto other = learn_params(rules, samples, parts, {}).value.value();
    CHECK(other.learnt_without[0] == learnt.learnt_without[0]);
    std::vector<Sample> others;
    for (const std::size_t i : outside(parts[0], all_samples(samples.size())))
      others.push_back(samples[i]);
    CHECK(fit_params(rules, others, {}).value == learnt.learnt_without[0]);
  }

  TEST_CASE("learning that nobody waits for is given up wherever it stands") {
    const RuleBase rules = with(sills(), {{"sill", 3.0}});
    const auto samples = samples_labelled_by(sills(), 6);
    const auto parts = folds_of(samples.size(), 3, 1);
    const auto learn = [&](const IsGivenUp& is_given_up) {
      const auto learnt = learn_params(rules, samples, parts, {}, for_each_in_turn, is_given_up);
      CHECK(learnt.issues.empty());
      return learnt.value.has_value();
    };
    const auto look = [&](const IsGivenUp& is_given_up) {
      return propose(rules, samples, parts, {}, for_each_in_turn, is_given_up).has_value();
    };
    for (const auto& work : {std::function<bool(const IsGivenUp&)>(learn), {look}}) {
      int asked = 0;
      CHECK(work([&] { return ++asked < 0; }));
      CHECK(asked > 10);
      for (int most = 0; most < asked; most = 2 * most + 1) {
        int count = 0;
        CHECK_FALSE(work([&] { return count++ == most; }));
        CHECK(count == most + 1);
      }
    }
  }

  TEST_CASE("nothing is fitted to samples without an object of the objective") {
    const RuleBase rules = sills();
    auto samples = samples_labelled_by(rules, 3);
    for (Sample& sample : samples)
      std::erase_if(sample.truth, [](const ExpectedObject& o) { return o.label == "door"; });
    LearnOptions options;
    options.objective = Objective::f1_of("door");
    const auto fitted = fit_params(rules, samples, options);
    REQUIRE(fitted.value);
    CHECK(fitted.value->empty());
    CHECK(fit_params(rules, {}, options).value == std::vector<ParamValue>{});
  }

  TEST_CASE("folds part samples evenly and the same way again") {
    for (const std::size_t folds : {0, 2, 5, 30}) {
      const auto parts = folds_of(13, folds, 7);
      CHECK(parts == folds_of(13, folds, 7));
      CHECK(parts.size() == (folds == 0 ? 13 : std::min<std::size_t>(folds, 13)));
      CHECK(samples_of_parts(parts) == all_samples(13));
      for (const SamplePart& part : parts) {
        CHECK(std::ranges::is_sorted(part));
        CHECK(part.size() + outside(part, all_samples(13)).size() == 13);
        CHECK(part.size() <= parts.back().size() + 1);
      }
    }
    CHECK(folds_of(0, 5, 1).empty());
  }

  TEST_CASE("the learnt pack labels as the params that were learnt") {
    const RuleBase residential = load_pack_file("residential").value.value();
    const auto samples = samples_labelled_by(residential, 8);
    const RuleBase moved = with(residential, {{"widest_window", 2.5}, {"parapet", 0.6}});
    const Learnt learnt = learnt_from(moved, samples,
                                      {.objective = Objective::macro_f1(),
                                       .restarts = 0,
                                       .params = {"widest_window", "parapet"}});
    REQUIRE(!learnt.params.empty());
    const auto pack =
        load_pack(learnt_pack(learnt, residential, "learnt", "residential"), "learnt.yaml");
    REQUIRE(pack.value);
    std::vector<ParamValue> values;
    for (const LearntParam& param : learnt.params) values.push_back(param.value);
    for (const Sample& sample : samples)
      CHECK(labels_of(*pack.value, sample) == labels_of(with(residential, values), sample));
  }

  TEST_CASE("slow: threads change nothing that is learnt") {
    const RuleBase rules = with(sills(), {{"sill", 3.0}, {"near", 1.5}});
    const auto samples = samples_labelled_by(sills(), 9);
    const ForEachShare by_two = [](std::size_t count, const auto& work) {
      const auto half = [&](std::size_t first) {
        for (std::size_t i = first; i < count; i += 2) work(i);
      };
      std::jthread other(half, 1);
      half(0);
    };
    const auto parts = folds_of(samples.size(), 4, 1);
    const auto one = learn_params(rules, samples, parts, {}).value.value();
    const auto two = learn_params(rules, samples, parts, {}, by_two).value.value();
    CHECK(to_json(one, rules) == to_json(two, rules));
    CHECK(learnt_pack(one, rules, "l", "s") == learnt_pack(two, rules, "l", "s"));
  }

  TEST_CASE("a value close to where many labels flip is a knife edge") {
    const RuleBase rules = sills();
    const auto samples = samples_labelled_by(rules, 8);
    // Heights are multiples of 0.2 m: at 0.99 of such a step a small change moves many.
    const auto edges = learnt_from(with(rules, {{"sill", 1.19}}), samples, {}).knife_edges;
    REQUIRE(!edges.empty());
    CHECK(edges[0].param == "sill");
    CHECK(edges[0].objects > 0);
  }

  TEST_CASE("learning that cannot be is refused with a code") {
    const RuleBase rules = sills();
    const auto samples = samples_labelled_by(rules, 6);
    LearnOptions options;
    options.params = {"sil", "unused"};
    CHECK(faults(rules, samples, options) ==
          "sil: R206 unknown param 'sil'; did you mean 'sill'?\n"
          "unused: R206 the param 'unused' cannot be learnt: no label depends on it\n");
    options = {};
    options.objective = Objective::f1_of("chimney");
    CHECK(faults(rules, samples, options) ==
          "F1 of chimney: R283 the truth has no chimney, whose F1 is the objective; it has door, "
          "window\n");
    CHECK(faults(rules, {samples[0]}, {}) ==
          "folds: R282 nothing is left to learn from: there is 1 building\n");
  }

  TEST_CASE("a fold without an object of a class is named") {
    const RuleBase rules = sills();
    auto samples = samples_labelled_by(rules, 4);
    for (std::size_t i = 1; i < samples.size(); ++i)
      std::erase_if(samples[i].truth, [](const ExpectedObject& o) { return o.label == "door"; });
    CHECK(faults(rules, samples, {}, Severity::warning).find("R285 it has no door") !=
          std::string::npos);
  }

  TEST_CASE("a value within a plateau has few decimals and stays where it can") {
    CHECK(value_within({0.2, 0.9, 1}, 0.3) == 0.3);
    CHECK(value_within({0.42, 0.58, 1}, 0.3) == 0.5);
    CHECK(value_within({0.421, 0.423, 1}, 0.3) == 0.422);
  }

  TEST_CASE("features are asked for on which the folds disagree") {
    const RuleBase rules = with(sills(), {{"sill", 3.0}});
    const auto samples = samples_labelled_by(sills(), 6);
    Learnt learnt;
    learnt.by_fold = {{{"sill", 1.0}}, {{"sill", 3.0}}, {}};
    const auto questions = open_questions(rules, samples, learnt, 7);
    REQUIRE(questions.size() == 7);
    for (const OpenQuestion& question : questions) {
      CHECK(question.disagreement > 0.3);
      CHECK(question.by_fold.size() == 2);
    }
  }
}

TEST_SUITE("interpret/learn") {
  TEST_CASE("costs are read with the line of what is wrong") {
    const auto costs =
        read_costs("truth,predicted,cost\n# doors matter\ndoor,window,5\n-,door,1\n", "costs.csv");
    REQUIRE(costs.value);
    CHECK(costs.value->size() == 2);
    std::string text;
    for (const Issue& issue : read_costs("door,window\ndoor,-,-1\n", "costs.csv").issues)
      text += to_string(issue) + "\n";
    CHECK(text.find("costs.csv:1: R211") != std::string::npos);
    CHECK(text.find("costs.csv:2: R212") != std::string::npos);
  }

  TEST_CASE("the least cost is learnt where errors are not alike") {
    const RuleBase rules = sills();
    const auto samples = samples_labelled_by(rules, 8);
    LearnOptions options;
    options.objective = Objective::least_cost({{{"door", "window"}, 5}, {{"window", "door"}, 0.1}});
    const Learnt learnt = learnt_from(with(rules, {{"sill", 0.3}}), samples, options);
    CHECK(learnt.held_out_before < 0);
    CHECK(learnt.held_out_after > learnt.held_out_before);
  }
}
