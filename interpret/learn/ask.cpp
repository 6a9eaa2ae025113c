#include "interpret/learn/ask.h"

#include "interpret/labelling/interpret.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

namespace oriel {

namespace {

/// The pack as each fold learnt it.
std::vector<RuleBase> packs_of_folds(const RuleBase& rules, const Learnt& learnt) {
  std::vector<RuleBase> packs;
  for (const auto& fold : learnt.by_fold)
    if (auto pack = with_params(rules, std::span(fold)); pack.value)
      packs.push_back(std::move(*pack.value));
  return packs;
}

double disagreement_of(const std::map<std::string, std::size_t>& by_fold) {
  std::size_t most = 0, all = 0;
  for (const auto& [label, count] : by_fold) {
    most = std::max(most, count);
    all += count;
  }
  return all == 0 ? 0 : 1 - static_cast<double>(most) / static_cast<double>(all);
}

void add_questions(const RuleBase& rules, std::span<const RuleBase> folds, const Sample& sample,
                   std::vector<OpenQuestion>& questions) {
  const FeatureTable& table = sample.features.table;
  const Interpretation said = interpret(rules, table, sample.features.graph);
  std::vector<Interpretation> others;
  for (const RuleBase& fold : folds)
    others.push_back(interpret(fold, table, sample.features.graph));
  for (std::size_t row = 0; row < said.verdicts.size(); ++row) {
    const Verdict& verdict = said.verdicts[row];
    OpenQuestion question;
    question.building = table.building();
    question.feature = table.id(verdict.feature);
    question.label = verdict.label.text();
    question.runner_up = verdict.runner_up.text();
    question.margin = verdict.margin;
    for (const Interpretation& other : others) ++question.by_fold[other.verdicts[row].label.text()];
    question.disagreement = disagreement_of(question.by_fold);
    if (!question.label.empty() || question.disagreement > 0)
      questions.push_back(std::move(question));
  }
}

}  // namespace

std::vector<OpenQuestion> open_questions(const RuleBase& rules, std::span<const Sample> samples,
                                         const Learnt& learnt, std::size_t count) {
  const std::vector<RuleBase> folds = packs_of_folds(rules, learnt);
  std::vector<OpenQuestion> questions;
  for (const Sample& sample : samples) add_questions(rules, folds, sample, questions);
  std::ranges::sort(questions, {}, [](const OpenQuestion& q) {
    return std::tuple(-q.disagreement, q.margin, std::string_view(q.building),
                      std::string_view(q.feature));
  });
  questions.resize(std::min(count, questions.size()));
  return questions;
}

std::string to_text(const std::vector<OpenQuestion>& questions) {
  std::string text = fmt::format("{:<24} {:<18} {:<12} {:<12} {:>6} {:>9}\n", "building", "feature",
                                 "label", "runner-up", "margin", "disagrees");
  for (const OpenQuestion& q : questions)
    text += fmt::format("{:<24} {:<18} {:<12} {:<12} {:>6.2f} {:>8.0f}%\n", printable(q.building),
                        printable(q.feature), q.label.empty() ? "-" : q.label,
                        q.runner_up.empty() ? "-" : q.runner_up, q.margin, 100 * q.disagreement);
  return text;
}

}  // namespace oriel
