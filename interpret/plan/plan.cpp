#include "interpret/plan/plan.h"

#include "interpret/evaluate/arithmetic.h"
#include "interpret/labelling/groups.h"
#include "interpret/labelling/labelling.h"
#include "interpret/pack/names.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel {

namespace {

using rules::ClassId;
using rules::ExprId;
using rules::GeneraliseEntry;
using rules::Truth;

InputError bad_scale(double scale) {
  Issue issue;
  issue.code = Code::R250;
  issue.sentence = fmt::format("a target scale is 1:N with N of at least 1, not 1:{}", scale);
  return InputError(std::move(issue));
}

/// The class of every feature, kNoClass for those without a label of this pack.
std::vector<ClassId> labels_of(const rules::Pack& pack, const Interpretation& interpretation,
                               std::size_t rows) {
  std::vector<ClassId> labels(rows, rules::kNoClass);
  for (const Verdict& verdict : interpretation.verdicts)
    if (verdict.feature.is_valid() && verdict.feature.index() < rows)
      labels[verdict.feature.index()] = rules::index_of(pack.classes, verdict.label);
  return labels;
}

/// Predicates are found again by their rules; a decided class is what the interpretation says.
void set_membership(const rules::Pack& pack, const std::vector<ClassId>& labels,
                    rules::EvaluationContext& context) {
  rules::Labelling(pack, context).run();
  for (ClassId id = 0; id < static_cast<ClassId>(pack.classes.size()); ++id) {
    const rules::Class& c = pack.classes[static_cast<std::size_t>(id)];
    if (c.is_abstract && c.has_rules) continue;
    auto& members = context.membership[static_cast<std::size_t>(id)];
    for (std::size_t row = 0; row < context.rows; ++row)
      members[row] = rules::truth_of(rules::is_within(pack.classes, labels[row], id));
  }
}

bool is_asking_for_class(const rules::ExprList& code, rules::ExprId id) {
  if (id == rules::kNoExpr) return false;
  const rules::Expr& expr = code[static_cast<std::size_t>(id)];
  if (expr.op == rules::Op::is_class) return true;
  for (const rules::ExprId arg : expr.args)
    if (is_asking_for_class(code, arg)) return true;
  return is_asking_for_class(code, expr.filter) || is_asking_for_class(code, expr.join) ||
         is_asking_for_class(code, expr.value);
}

/// Marks the features that an entry is for.
void mark_targets(const rules::Pack& pack, const GeneraliseEntry& entry,
                  const std::vector<ClassId>& labels, const Interpretation& interpretation,
                  std::vector<Truth>& fits) {
  std::ranges::fill(fits, Truth::no);
  if (entry.group < 0) {
    for (std::size_t row = 0; row < fits.size(); ++row)
      fits[row] = rules::truth_of(entry.target == rules::kNoClass ||
                                  rules::is_within(pack.classes, labels[row], entry.target));
    return;
  }
  const std::string& kind = pack.groups[static_cast<std::size_t>(entry.group)].name;
  for (const Group& group : interpretation.groups)
    for (const FeatureId member : group.members)
      if (group.kind == kind) fits[member.index()] = Truth::yes;
}

/// Takes back the marks of features whose `when` is not true.
void judge_condition(ExprId when, const rules::EvaluationContext& context,
                     rules::Evaluator& evaluator, std::vector<Truth>& fits) {
  if (when == rules::kNoExpr) return;
  for (const int row : context.row_numbers) {
    Truth& fit = fits[static_cast<std::size_t>(row)];
    if (fit != Truth::no) fit = std::min(fit, evaluator.truth(when, rules::rows_of(row)));
  }
}

/// A group is redrawn as a whole: an entry fits it if it fits all its members.
void keep_whole_groups(const std::string& kind, const Interpretation& interpretation,
                       std::vector<Truth>& fits) {
  for (const Group& group : interpretation.groups) {
    if (group.kind != kind) continue;
    const auto is_fit = [&](FeatureId member) { return fits[member.index()] == Truth::yes; };
    if (std::ranges::all_of(group.members, is_fit)) continue;
    for (const FeatureId member : group.members) fits[member.index()] = Truth::no;
  }
}

/// The group of the entry's kind that the feature is in; empty if the entry is not for groups.
std::string group_of(const rules::Pack& pack, const GeneraliseEntry& entry, FeatureId feature,
                     const Interpretation& interpretation) {
  if (entry.group < 0) return {};
  const std::string& kind = pack.groups[static_cast<std::size_t>(entry.group)].name;
  for (const Group& group : interpretation.groups)
    if (group.kind == kind && std::ranges::binary_search(group.members, feature)) return group.id;
  return {};
}

Step step_of(const rules::Pack& pack, const GeneraliseEntry& entry, FeatureId feature,
             const rules::EvaluationContext& context, const Interpretation& interpretation) {
  Step step{feature, entry.operation, entry.id};
  step.group = group_of(pack, entry, feature, interpretation);
  for (const GeneraliseEntry::Argument& argument : entry.arguments)
    if (argument.value == rules::kNoExpr)
      step.words[argument.name] = argument.word;
    else if (const auto value =
                 rules::fold(pack, argument.value, context.values.params, context.scale))
      step.numbers[argument.name] = *value;
  return step;
}

/// What the pack calls an opening.
std::vector<FeatureId> openings_of(const rules::Pack& pack, const std::vector<ClassId>& labels) {
  std::vector<FeatureId> openings;
  const ClassId opening = rules::index_of(pack.classes, "opening");
  for (std::size_t row = 0; opening != rules::kNoClass && row < labels.size(); ++row)
    if (rules::is_within(pack.classes, labels[row], opening))
      openings.push_back(FeatureId{static_cast<int>(row)});
  return openings;
}

/// An opening that is enlarged pushes others aside.
void add_openings(std::vector<FeatureId> openings, Plan& plan) {
  const auto shared = std::make_shared<const std::vector<FeatureId>>(std::move(openings));
  for (Step& step : plan.steps)
    if (step.operation == "enlarge" && std::ranges::binary_search(*shared, step.feature))
      step.openings = shared;
}

/// What belongs to a feature by an entry: where its relation leads to what has no step of its own,
/// or only one that removes it.
std::vector<FeatureId> belonging_to(const rules::EvaluationContext& context,
                                    const std::vector<ClassId>& labels,
                                    const std::vector<const GeneraliseEntry*>& chosen,
                                    const GeneraliseEntry& entry, int row) {
  std::vector<FeatureId> along;
  if (entry.with < 0) return along;
  const rules::Links& links = context.relations[static_cast<std::size_t>(entry.with)];
  const auto [begin, end] = links.range_of(row);
  for (std::size_t link = begin; link < end; ++link) {
    if (links.other(link) == row) continue;
    const auto other = static_cast<std::size_t>(links.other(link));
    const bool is_meant =
        entry.with_of == rules::kNoClass
            ? labels[other] == rules::kNoClass
            : context.membership[static_cast<std::size_t>(entry.with_of)][other] == Truth::yes;
    if (is_meant && links.is_other(row, link) == Truth::yes &&
        (chosen[other] == nullptr || chosen[other]->operation == "omit"))
      along.push_back(FeatureId{links.other(link)});
  }
  std::ranges::sort(along);
  return along;
}

/// Those that an operator may draw again: they have no step of their own.
std::vector<FeatureId> without_step(std::vector<FeatureId> features,
                                    const std::vector<const GeneraliseEntry*>& chosen) {
  std::erase_if(features, [&](FeatureId id) { return chosen[id.index()] != nullptr; });
  return features;
}

/// What becomes of what belongs to the features of the steps, and to the openings that they push.
void add_belonging(const rules::EvaluationContext& context, const std::vector<ClassId>& labels,
                   const std::vector<const GeneraliseEntry*>& chosen, Plan& plan) {
  std::map<const GeneraliseEntry*, std::shared_ptr<const BelongingOf>> of_pushed;
  for (Step& step : plan.steps) {
    const GeneraliseEntry& entry = *chosen[step.feature.index()];
    step.with =
        belonging_to(context, labels, chosen, entry, static_cast<int>(step.feature.index()));
    if (entry.with_as == Belonging::goes) continue;
    step.belonging = entry.with_as;
    step.follows = without_step(step.with, chosen);
    if (!step.openings) continue;
    auto& pushed = of_pushed[&entry];
    if (!pushed) {
      BelongingOf found;
      for (const FeatureId id : *step.openings)
        if (auto its = without_step(
                belonging_to(context, labels, chosen, entry, static_cast<int>(id.index())), chosen);
            !its.empty())
          found.emplace(id, std::move(its));
      pushed = std::make_shared<const BelongingOf>(std::move(found));
    }
    step.follows_pushed = pushed;
  }
}

}  // namespace

Plan plan(const RuleBase& base, const FeatureTable& table, const FeatureGraph& graph,
          const Interpretation& interpretation, double scale_denominator) {
  if (!std::isfinite(scale_denominator) || scale_denominator < 1)
    throw bad_scale(scale_denominator);
  const rules::Pack& pack = base.pack();
  const std::vector<ClassId> labels = labels_of(pack, interpretation, table.rows());
  rules::EvaluationContext context(pack, base.values(), table, graph);
  context.scale = scale_denominator;
  const bool needs_classes = std::ranges::any_of(pack.entries, [&](const GeneraliseEntry& e) {
    return e.with_of != rules::kNoClass || is_asking_for_class(pack.code, e.when);
  });
  if (needs_classes) set_membership(pack, labels, context);

  std::vector<const GeneraliseEntry*> chosen(context.rows, nullptr);
  std::vector<Truth> fits(context.rows);
  // gap(members) follows the columns of the schema.
  std::vector<double> gaps;
  context.columns.emplace_back();
  rules::Evaluator evaluator(pack, context);
  for (const GeneraliseEntry& entry : pack.entries) {
    if (scale_denominator < entry.scale_from || scale_denominator > entry.scale_to) continue;
    mark_targets(pack, entry, labels, interpretation, fits);
    if (entry.group >= 0) {
      const std::string& kind = pack.groups[static_cast<std::size_t>(entry.group)].name;
      context.columns.back() = gaps = rules::group_gaps(kind, table, graph, interpretation);
    }
    judge_condition(entry.when, context, evaluator, fits);
    if (entry.group >= 0)
      keep_whole_groups(pack.groups[static_cast<std::size_t>(entry.group)].name, interpretation,
                        fits);
    for (std::size_t row = 0; row < fits.size(); ++row)
      if (fits[row] == Truth::yes && chosen[row] == nullptr) chosen[row] = &entry;
  }

  Plan result;
  result.scale = scale_denominator;
  for (std::size_t row = 0; row < chosen.size(); ++row)
    if (chosen[row] != nullptr)
      result.steps.push_back(
          step_of(pack, *chosen[row], FeatureId{static_cast<int>(row)}, context, interpretation));
  add_openings(openings_of(pack, labels), result);
  add_belonging(context, labels, chosen, result);
  return result;
}

std::vector<double> plan_bounds(const RuleBase& base) {
  std::vector<double> bounds;
  for (const GeneraliseEntry& entry : base.pack().entries)
    for (const double bound : {entry.scale_from, entry.scale_to})
      if (std::isfinite(bound)) bounds.push_back(bound);
  std::ranges::sort(bounds);
  bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
  return bounds;
}

}  // namespace oriel
