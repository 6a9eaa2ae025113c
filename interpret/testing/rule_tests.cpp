#include "interpret/testing/rule_tests.h"

#include "interpret/explain/explain.h"
#include "interpret/labelling/interpret.h"
#include "interpret/labelling/labelling.h"
#include "interpret/testing/fixture.h"
#include "interpret/testing/test_file.h"
#include "interpret/yaml/section.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <span>

#include <fmt/format.h>

namespace oriel {

namespace {

using rules::RuleTest;

/// Counts which rules and conditions held and failed.
class CoverageCounter {
 public:
  CoverageCounter(const rules::Pack& pack, const std::string& file) : pack_(&pack) {
    for (const rules::Rule& rule : pack.rules) {
      RuleCoverage coverage;
      coverage.id = rule.id;
      coverage.place = pack.source.place(rule.span.begin);
      coverage.is_own = coverage.place.file == file;
      coverage.is_predicate = pack.classes[static_cast<std::size_t>(rule.label)].is_abstract;
      conditions_.emplace_back();
      for (const rules::ExprId id : rule.require) add(id, coverage);
      for (const rules::ExprId id : rule.unless) add(id, coverage);
      rules_.push_back(std::move(coverage));
    }
  }

  void count(const DescribedBuilding& building) {
    rules::EvaluationContext context(*pack_, rules::PackValues(*pack_), building.table,
                                     building.graph);
    if (context.rows == 0) return;
    for (const rules::Choice& choice : rules::Labelling(*pack_, context).run())
      if (choice.rule >= 0) ++rules_[static_cast<std::size_t>(choice.rule)].decided;
    rules::Evaluator evaluator(*pack_, context);
    for (std::size_t i = 0; i < rules_.size(); ++i) count_rule(i, evaluator, context);
  }

  /// Own rules first.
  [[nodiscard]] std::vector<RuleCoverage> rules() const {
    std::vector<RuleCoverage> sorted = rules_;
    std::ranges::stable_partition(sorted, &RuleCoverage::is_own);
    return sorted;
  }

 private:
  void add(rules::ExprId id, RuleCoverage& coverage) {
    const rules::Expr& expr = pack_->code[static_cast<std::size_t>(id)];
    if (expr.op == rules::Op::all_of) {
      for (const rules::ExprId arg : expr.args) add(arg, coverage);
      return;
    }
    conditions_.back().push_back(id);
    ConditionCoverage condition;
    condition.text = pack_->source.text_of(expr.span);
    condition.place = pack_->source.place(expr.span.begin);
    coverage.conditions.push_back(std::move(condition));
  }

  void count_rule(std::size_t i, rules::Evaluator& evaluator,
                  const rules::EvaluationContext& context) {
    const std::span<const int> rows = context.row_numbers;
    for (const auto& judgement : rules::judge(*pack_, pack_->rules[i], evaluator, rows))
      if (judgement.truth == rules::Truth::yes) ++rules_[i].held;
    for (std::size_t c = 0; c < conditions_[i].size(); ++c)
      for (const int row : rows) {
        const rules::Truth truth = evaluator.truth(conditions_[i][c], rules::rows_of(row));
        ConditionCoverage& coverage = rules_[i].conditions[c];
        if (truth == rules::Truth::yes) ++coverage.held;
        if (truth == rules::Truth::no) ++coverage.failed;
        if (truth == rules::Truth::unknown)
          find_missing(conditions_[i][c], context, row, coverage.missing);
      }
  }

  /// Adds the attributes of the feature itself that the expression reads and that have no value.
  void find_missing(rules::ExprId id, const rules::EvaluationContext& context, int row,
                    std::vector<std::string>& missing) const {
    const rules::Expr& expr = pack_->code[static_cast<std::size_t>(id)];
    for (const rules::ExprId arg : expr.args) find_missing(arg, context, row, missing);
    const bool is_attribute = expr.op == rules::Op::attribute || expr.op == rules::Op::flag;
    if (expr.level > 0 || (!is_attribute && expr.op != rules::Op::facet_is)) return;
    const std::size_t column = expr.op == rules::Op::facet_is
                                   ? column_of(Attribute::host_inclination)
                                   : static_cast<std::size_t>(expr.index);
    const std::string& name = feature_schema()[column].name;
    if (std::isnan(context.columns[column][static_cast<std::size_t>(row)]) &&
        std::ranges::find(missing, name) == missing.end())
      missing.push_back(name);
  }

  const rules::Pack* pack_;
  std::vector<RuleCoverage> rules_;
  std::vector<std::vector<rules::ExprId>> conditions_;
};

const char* outcome_word(Outcome outcome) {
  if (outcome == Outcome::unknown) return "unknown";
  return outcome == Outcome::holds ? "holds" : "fails";
}

/// True if a condition with that text, or a part of one, has that outcome.
bool has_condition(const std::vector<ConditionReport>& reports, const std::string& text,
                   Outcome outcome) {
  return std::ranges::any_of(reports, [&](const ConditionReport& report) {
    return (report.text == text && report.outcome == outcome) ||
           has_condition(report.parts, text, outcome);
  });
}

/// One test at work on its buildings.
class TestRun {
 public:
  TestRun(const RuleBase& base, const RuleTest& test, RuleTestResult& result)
      : base_(base), test_(test), result_(result) {}

  void run(const std::vector<DescribedBuilding>& buildings) {
    for (const DescribedBuilding& building : buildings) {
      interpretations_.push_back(interpret(base_, building.table, building.graph));
      for (const Group& group : interpretations_.back().groups) ++groups_[group.kind];
      for (const Verdict& verdict : interpretations_.back().verdicts) ++counts_[verdict.label];
    }
    for (const rules::Expectation& expected : test_.labels) check_labels(expected, buildings);
    for (const auto& [label, count] : test_.counts) {
      const std::string& found = label == "unknown" ? "" : label;
      check_count("feature", " labelled " + label, counts_[found], count);
      if (counts_[found] > count) mark_labelled(found, buildings);
    }
    for (const auto& [group, count] : test_.groups)
      check_count("group", " " + group, groups_[group], count);
    if (test_.perturbation) check_property(buildings);
    std::ranges::sort(result_.unexpected);
    const auto twice = std::ranges::unique(result_.unexpected);
    result_.unexpected.erase(twice.begin(), twice.end());
  }

 private:
  void fail(std::string sentence) { result_.failures.push_back(std::move(sentence)); }
  /// Of one feature.
  void fail(const FeatureTable& table, FeatureId feature, std::string sentence) {
    fail(std::move(sentence));
    result_.unexpected.emplace_back(table.building(), table.id(feature));
  }
  /// One of them is too many.
  void mark_labelled(const std::string& label, const std::vector<DescribedBuilding>& buildings) {
    for (std::size_t b = 0; b < buildings.size(); ++b)
      for (const Verdict& verdict : interpretations_[b].verdicts)
        if (verdict.label == label)
          result_.unexpected.emplace_back(buildings[b].table.building(),
                                          buildings[b].table.id(verdict.feature));
  }

  void check_count(std::string_view noun, const std::string& which, std::size_t found,
                   std::size_t wanted) {
    if (found != wanted)
      fail(fmt::format("{}{}, expected {}", counted(found, noun), which, wanted));
  }

  void check_labels(const rules::Expectation& expected,
                    const std::vector<DescribedBuilding>& buildings) {
    bool has_match = false;
    for (std::size_t b = 0; b < buildings.size(); ++b)
      for (const Verdict& verdict : interpretations_[b].verdicts) {
        const std::string& id = buildings[b].table.id(verdict.feature);
        if (!rules::is_match(expected.pattern, id)) continue;
        has_match = true;
        check_label(expected, buildings[b].table, verdict);
        for (const rules::Reason& reason : test_.because)
          check_reason(reason, buildings[b], interpretations_[b], verdict.feature);
      }
    if (!has_match) fail(fmt::format("nothing is called '{}'", expected.pattern));
  }

  void check_label(const rules::Expectation& expected, const FeatureTable& table,
                   const Verdict& verdict) {
    const rules::Pack& pack = base_.pack();
    const rules::ClassId label = rules::index_of(pack.classes, verdict.label);
    const bool is_one =
        expected.label == "unknown"
            ? verdict.label.empty()
            : rules::is_within(pack.classes, label, rules::index_of(pack.classes, expected.label));
    if (is_one != expected.is_negated) return;
    std::string found = verdict.label.empty() ? "unknown" : verdict.label;
    if (!verdict.rule.empty()) found += fmt::format(" {:.2f} by {}", verdict.score, verdict.rule);
    fail(table, verdict.feature,
         fmt::format("{} is {}, expected {}{}", table.id(verdict.feature), found,
                     expected.is_negated ? "not " : "", expected.label));
  }

  void check_reason(const rules::Reason& reason, const DescribedBuilding& building,
                    const Interpretation& interpretation, FeatureId feature) {
    const std::string& id = building.table.id(feature);
    const Explanation why =
        Explainer(base_, building.table, building.graph, interpretation).explain(feature);
    const auto rule = std::ranges::find(why.rules, reason.rule, &RuleReport::id);
    if (reason.condition.empty()) {
      if (rule->outcome != reason.outcome)
        fail(building.table, feature,
             fmt::format("{}: {} {}, expected that it {}", id, reason.rule,
                         outcome_word(rule->outcome), outcome_word(reason.outcome)));
      return;
    }
    if (rule->outcome == reason.outcome &&
        (has_condition(rule->require, reason.condition, reason.outcome) ||
         has_condition(rule->unless, reason.condition, Outcome::holds)))
      return;
    fail(building.table, feature,
         fmt::format("{}: {} {}, expected that it {} at \"{}\"", id, reason.rule,
                     outcome_word(rule->outcome), outcome_word(reason.outcome), reason.condition));
  }

  /// Every copy with noise must have the labels of the original.
  void check_property(const std::vector<DescribedBuilding>& buildings) {
    const rules::TablePerturbation& p = *test_.perturbation;
    rules::Noise noise;
    for (int round = 1; round <= p.times; ++round)
      for (std::size_t b = 0; b < buildings.size(); ++b) {
        const FeatureTable moved = rules::perturbed(buildings[b].table, p, noise);
        const auto verdicts = interpret(base_, moved, buildings[b].graph).verdicts;
        for (std::size_t row = 0; row < verdicts.size(); ++row) {
          const std::string& before = interpretations_[b].verdicts[row].label;
          if (verdicts[row].label == before) continue;
          fail(moved, verdicts[row].feature,
               fmt::format("perturbation {} makes {} {} of {}", round,
                           moved.id(verdicts[row].feature),
                           verdicts[row].label.empty() ? "unknown" : verdicts[row].label,
                           before.empty() ? "unknown" : before));
          return;
        }
      }
  }

  const RuleBase& base_;
  const RuleTest& test_;
  RuleTestResult& result_;
  std::vector<Interpretation> interpretations_;
  std::map<std::string, std::size_t> groups_;
  std::map<std::string, std::size_t> counts_;
};

/// The buildings of a test; without any its failures.
std::vector<DescribedBuilding> buildings_of(const RuleTest& test, const BuildingReader& read,
                                            RuleTestResult& result) {
  std::vector<DescribedBuilding> buildings;
  if (test.building.empty()) {
    buildings.push_back(rules::make_building(test.name, test.fixture));
    return buildings;
  }
  auto read_back = read(result.building);
  if (read_back.value) buildings = std::move(*read_back.value);
  std::size_t features = 0;
  for (const DescribedBuilding& building : buildings) features += building.table.rows();
  if (features > 0) return buildings;
  result.failures.push_back("nothing was found in '" + test.building + "'");
  for (const Issue& issue : read_back.issues) result.failures.push_back(to_string(issue));
  return buildings;
}

bool is_asked(const RuleCoverage& rule, CoverageOf of) {
  return rule.is_own || of == CoverageOf::all_rules;
}

}  // namespace

std::size_t RuleTestReport::failed() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      tests, [](const RuleTestResult& result) { return !result.failures.empty(); }));
}

std::size_t RuleTestReport::rule_count(CoverageOf of) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(rules, [&](const RuleCoverage& rule) { return is_asked(rule, of); }));
}

double RuleTestReport::rule_coverage(CoverageOf of) const {
  const auto covered = std::ranges::count_if(
      rules, [&](const RuleCoverage& rule) { return is_asked(rule, of) && rule.held > 0; });
  const std::size_t all = rule_count(of);
  return all == 0 ? 1 : static_cast<double>(covered) / static_cast<double>(all);
}

double RuleTestReport::condition_coverage(CoverageOf of) const {
  std::size_t all = 0, covered = 0;
  for (const RuleCoverage& rule : rules) {
    if (!is_asked(rule, of)) continue;
    all += rule.conditions.size();
    covered += static_cast<std::size_t>(
        std::ranges::count_if(rule.conditions, &ConditionCoverage::is_covered));
  }
  return all == 0 ? 1 : static_cast<double>(covered) / static_cast<double>(all);
}

Checked<RuleTestReport> run_rule_tests(const std::string& path, const BuildingReader& read) {
  Checked<RuleTestReport> checked;
  const auto file = rules::read_test_file(path, checked.issues);
  if (!file) return checked;
  RuleTestReport report;
  report.file = path;
  report.pack = file->base;
  CoverageCounter coverage(file->base->pack(), file->base->file());
  const auto folder = std::filesystem::path(path).parent_path();
  for (const RuleTest& test : file->tests) {
    RuleTestResult& result = report.tests.emplace_back();
    result.name = test.name;
    result.place = test.place;
    if (!test.building.empty()) result.building = (folder / test.building).string();
    const auto buildings = buildings_of(test, read, result);
    if (result.failures.empty()) TestRun(*file->base, test, result).run(buildings);
    for (const DescribedBuilding& building : buildings) coverage.count(building);
  }
  report.rules = coverage.rules();
  checked.value = std::move(report);
  return checked;
}

}  // namespace oriel
