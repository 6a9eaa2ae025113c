#include "interpret/surfaces/untyped.h"

#include "interpret/compile/emitted.h"
#include "interpret/pack/pack.h"
#include "kernel/base/text/counted.h"

#include <fmt/format.h>

namespace oriel {

namespace {

Issue untyped_label(const rules::Pack& pack, const rules::Class& c, int features) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::R258;
  issue.sentence = fmt::format(
      "{} with the label '{}' {} written without a type, {}: {}", counted(features, "feature"),
      c.name, agreeing(features, "is", "are"), rules::kGenericForms, rules::advice_to_emit(c.name));
  issue.place = pack.source.place(c.span.begin);
  issue.excerpt = pack.source.excerpt(c.span);
  return issue;
}

}  // namespace

std::map<std::string, int> count_labels(const Interpretation& interpretation) {
  std::map<std::string, int> counts;
  for (const Verdict& verdict : interpretation.verdicts) ++counts[verdict.label];
  return counts;
}

std::vector<Issue> report_untyped(const std::map<std::string, int>& features_by_label,
                                  const RuleBase& base) {
  const rules::Pack& pack = base.pack();
  std::vector<Issue> issues;
  for (const rules::Class& c : pack.classes) {
    const auto counted = features_by_label.find(c.name);
    if (counted == features_by_label.end() || counted->second <= 0) continue;
    if (!rules::is_label_emitted(pack, c.name))
      issues.push_back(untyped_label(pack, c, counted->second));
  }
  return issues;
}

}  // namespace oriel
