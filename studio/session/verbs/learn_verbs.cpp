#include "oriel/explain.h"
#include "oriel/learn.h"
#include "studio/session/desk.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

/// So many values over the range of a param make a curve, besides the one that it has.
constexpr int kCurveValues = 32;
/// So many questions at most.
constexpr std::size_t kMostQuestions = 10000;

constexpr const char* kMacroF1 = "macro_f1";

Objective asked_objective(const RequestBody& body, const RuleBase& rules) {
  const std::string word = body.optional_text("objective").value_or(kMacroF1);
  if (word == kMacroF1) return Objective::macro_f1();
  const auto labels = rules.labels();
  if (std::ranges::find(labels, word) == labels.end())
    throw RefusedRequest(
        400, fmt::format("'objective' is {} or a class of the pack, not '{}'", kMacroF1, word));
  return Objective::f1_of(word);
}

/// Throws RefusedRequest 409 if nobody says anything of any building.
std::shared_ptr<const SampleList> samples_with_truth(Desk& desk) {
  auto samples = desk.samples.with_truth(desk.buildings.list(), *desk.corrections.truth());
  if (samples->samples.empty())
    throw RefusedRequest(409, "there is no truth and no correction to learn from");
  return samples;
}

/// Values over the range, ascending, with which the pack can be loaded; that of the pack among
/// them.
std::vector<double> values_of_curve(const RuleBase& rules, const PackParam& param) {
  const auto& [low, high] = *param.range;
  std::set<double> values{param.value};
  for (int i = 1; i < kCurveValues; ++i)
    values.insert(rounded(low + (high - low) * i / kCurveValues, 6));
  values.insert({low, high});
  std::vector<double> sound;
  for (const double value : values) {
    const std::vector<ParamValue> assigned{{param.name, value}};
    if (with_params(rules, assigned).value) sound.push_back(value);
  }
  return sound;
}

/// A feature that is asked about.
struct AskedFeature {
  const LabelledFeatures& labelled;
  FeatureId feature;

  [[nodiscard]] bool is_corrected(const TruthOfSession& truth) const {
    std::vector<Issue> issues;
    const OpenBuilding& open = *labelled.building;
    const auto corrected = truth.corrections.find(open.building->id, open.features, issues);
    return std::ranges::find(corrected, feature.index(), &CorrectedFeature::feature) !=
           corrected.end();
  }
};

std::string sentence_of(const AskedFeature& asked, const OpenQuestion& question) {
  const LabelledFeatures& labelled = asked.labelled;
  const std::string sentence =
      plain_sentence(labelled.building->segmented, labelled.interpretation, asked.feature);
  if (question.disagreement > 0)
    return sentence + fmt::format("; {:.0f} % of what was learnt calls it something else",
                                  100 * question.disagreement);
  if (question.runner_up.empty()) return sentence;
  return sentence + fmt::format("; ahead of {} by {:.2f}", question.runner_up, question.margin);
}

}  // namespace

StudioJson answer_curve(Desk& desk, const RequestBody& body) {
  const std::string name = body.text("param");
  const auto label = body.optional_text("class");
  const auto all = desk.runner.need_current();
  const RuleBase& rules = all->rules;
  const auto params = params_of(rules);
  const auto param = std::ranges::find(params, name, &PackParam::name);
  if (param == params.end())
    throw RefusedRequest(400, fmt::format("the pack has no param '{}'", name), Code::R206);
  if (!param->range)
    throw RefusedRequest(400,
                         fmt::format("the param '{}' has no range to draw a curve over", name));
  const auto samples = samples_with_truth(desk);
  const std::vector<double> values = values_of_curve(rules, *param);
  std::vector<Variant> variants;
  for (const double value : values) variants.push_back(variant_with(rules, {{name, value}}));
  const auto counts = count_variants(rules, variants, samples->samples, {}, desk.options.for_each);
  if (!counts.value) throw RefusedRequest(400, counts.issues.front().sentence);
  StudioJson f1 = StudioJson::array();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto classes = counts.value->total(i);
    if (!label) {
      f1.push_back(number_or_null(macro_f1(classes)));
      continue;
    }
    const auto found = classes.find(*label);
    f1.push_back(found == classes.end() ? StudioJson() : number_or_null(found->second.f1()));
  }
  return {{"values", values}, {"f1", std::move(f1)}, {"at", param->value}};
}

StudioJson answer_learn(Desk& desk, const RequestBody& body) {
  const bool proposes = body.flag("propose");
  if (body.has("accept"))
    return desk.learning.accept(body.number("accept", kMostQuestions, "proposal"),
                                body.text("text"));
  if (body.flag("stop")) {
    desk.learning.stop();
  } else if (body.has("objective") || body.has("params") || proposes) {
    const auto all = desk.runner.need_current();
    LearningTask task{all->rules, all->text, desk.file.name(),     samples_with_truth(desk),
                      {},         proposes,  desk.options.for_each};
    task.options.objective = asked_objective(body, all->rules);
    task.options.params = body.texts("params");
    desk.learning.start(std::move(task));
  }
  return desk.learning.json();
}

StudioJson answer_ask(Desk& desk, const RequestBody& body) {
  const std::size_t count = body.number("count", kMostQuestions + 1, "list of so many questions");
  const auto all = desk.runner.need_current();
  const auto truth = desk.corrections.truth();
  const SampleList list = samples_of(desk.buildings.list());
  const auto learnt = desk.learning.learnt(all->rules);
  std::map<std::string, std::size_t> numbers;
  for (const std::size_t number : list.numbers)
    numbers.emplace(all->buildings.at(number)->building->building->id, number);
  const std::size_t answered = desk.corrections.list().size();
  StudioJson parts = StudioJson::array();
  for (const OpenQuestion& question :
       open_questions(all->rules, list.samples, learnt ? *learnt : Learnt{}, count + answered)) {
    if (parts.size() == count) break;
    const std::size_t number = numbers.at(question.building);
    const LabelledFeatures& labelled = *all->buildings[number];
    const FeatureId feature = labelled.building->segmented.description.table.find(question.feature);
    const AskedFeature asked{labelled, feature};
    if (!feature.is_valid() || asked.is_corrected(*truth)) continue;
    parts.push_back({{"building", number},
                     {"feature", feature.value},
                     {"sentence", sentence_of(asked, question)}});
  }
  return {{"parts", std::move(parts)}};
}

}  // namespace oriel::studio
