#include "oriel/score.h"

#include "oriel/rules.h"
#include "python/src/handles.h"

#include <algorithm>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace py = pybind11;

namespace oriel::python {

namespace {

/// A comparison of labels with truth, with all that was asked for.
struct ScoreReport {
  Score total;
  std::map<std::string, Score> buildings;
  std::optional<Intervals> intervals;
  std::optional<AreaScore> areas;
  std::optional<std::map<std::string, RuleScore>> rules;
  std::vector<Issue> issues;
};

TruthSet read_truth_files(const std::vector<std::string>& paths) {
  TruthSet all;
  for (const std::string& path : paths) {
    auto truths = read_truths(path);
    all.issues.insert(all.issues.end(), truths.issues.begin(), truths.issues.end());
    if (!truths.value) continue;
    for (GroundTruth& truth : *truths.value) all.buildings.push_back(std::move(truth));
  }
  return all;
}

LabelsAndTruth compared_by(const FeatureSet& set, const TruthSet& truth) {
  LabelsAndTruth all;
  for (std::size_t b = 0; b < set.buildings->size(); ++b) add(records_of(set, b, false), all);
  for (const GroundTruth& building : truth.buildings) add(building, all);
  return all;
}

/// A warning E131 if buildings of the truth have no features: all that is there counts as missed.
std::optional<Issue> without_features(const FeatureSet& set, const TruthSet& truth) {
  constexpr std::size_t kShown = 5;
  std::set<std::string> missing;
  for (const GroundTruth& building : truth.buildings)
    if (!building.objects.empty()) missing.insert(building.building);
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E131;
  if (missing.empty()) {
    issue.sentence = "the truth has no objects: nothing is compared";
    return issue;
  }
  const std::size_t expected = missing.size();
  for (const DescribedBuilding& building : *set.buildings) missing.erase(building.table.building());
  if (missing.empty()) return std::nullopt;
  const std::vector<std::string> ids(missing.begin(), missing.end());
  issue.sentence = fmt::format(
      "{} of {} buildings of the truth have no features, and all their objects count as missed: "
      "{}{}",
      ids.size(), expected,
      fmt::join(ids.begin(), ids.begin() + std::ptrdiff_t(std::min(kShown, ids.size())), ", "),
      ids.size() > kShown ? ", ..." : "");
  return issue;
}

AreaScore areas_of(const std::vector<ReadBuilding>& models, const LabelsAndTruth& all) {
  AreaScore areas;
  std::set<std::string> compared;
  for (const ReadBuilding& model : models)
    if (!compared.contains(model.building().id) && compare_areas(model.building(), all, {}, areas))
      compared.insert(model.building().id);
  return areas;
}

ScoreReport score_features(const FeatureSet& set, const TruthSet& truth, double iou,
                           std::size_t samples, bool is_by_rule,
                           const std::optional<RuleBase>& rules,
                           const std::optional<std::vector<ReadBuilding>>& models) {
  if (!(iou > 0 && iou <= 1))
    throw py::value_error(fmt::format("iou is {}; it must be above 0 and at most 1", iou));
  ScoreOptions options;
  options.min_iou = iou;
  const LabelsAndTruth all = compared_by(set, truth);
  ScoreReport report;
  if (const auto issue = without_features(set, truth)) report.issues.push_back(*issue);
  report.buildings = score_by_building(all, options);
  report.total = total(report.buildings);
  if (models) report.areas = areas_of(*models, all);
  if (is_by_rule) {
    report.rules = score_by_rule(all.predictions, report.total);
    if (rules) add_rules_without_decision(*rules, *report.rules);
  }
  if (samples > 0) report.intervals = bootstrap(report.buildings, samples);
  return report;
}

std::string json_of_report(const ScoreReport& report) {
  std::vector<std::string> members;
  if (report.areas) members.push_back(area_json(*report.areas));
  if (report.rules) members.push_back(rules_json(*report.rules));
  if (report.intervals) members.push_back(intervals_json(*report.intervals));
  return to_json(report.total, members);
}

/// As the command prints it.
std::string text_of_report(const ScoreReport& report) {
  constexpr std::size_t kShown = 20;
  std::string text = to_text(report.total, kShown);
  if (report.areas) text += to_text(*report.areas);
  if (report.rules) text += to_text(*report.rules, kShown);
  if (report.intervals) text += to_text(*report.intervals);
  return text;
}

/// (low, high) of each class, and of the mean of all as "macro_f1".
std::map<std::string, std::pair<double, double>> interval_map(const ScoreReport& report) {
  std::map<std::string, std::pair<double, double>> found;
  if (!report.intervals) return found;
  for (const auto& [label, interval] : report.intervals->f1)
    found[label] = {interval.low, interval.high};
  found["macro_f1"] = {report.intervals->macro_f1.low, report.intervals->macro_f1.high};
  return found;
}

std::map<std::string, std::map<std::string, ClassScore>> classes_by_building(
    const ScoreReport& report) {
  std::map<std::string, std::map<std::string, ClassScore>> found;
  for (const auto& [building, score] : report.buildings) found[building] = score.classes;
  return found;
}

}  // namespace

void bind_score(py::module_& module) {
  py::class_<TruthSet>(module, "Truth", "The true objects of buildings.")
      .def_property_readonly(
          "buildings",
          [](const TruthSet& truth) {
            std::vector<std::string> ids;
            for (const GroundTruth& b : truth.buildings) ids.push_back(b.building);
            return ids;
          },
          "Their ids.")
      .def_readonly("issues", &TruthSet::issues, "What could not be read.")
      .def("__repr__", [](const TruthSet& truth) {
        return fmt::format("<oriel.Truth: {} buildings>", truth.buildings.size());
      });
  py::class_<ClassScore>(module, "ClassScore",
                         "How a class was found. Ratios without a "
                         "denominator are NaN.")
      .def_readonly("tp", &ClassScore::true_positives)
      .def_readonly("fp", &ClassScore::false_positives)
      .def_readonly("fn", &ClassScore::false_negatives)
      .def_property_readonly("precision", &ClassScore::precision)
      .def_property_readonly("recall", &ClassScore::recall)
      .def_property_readonly("f1", &ClassScore::f1)
      .def("__repr__", [](const ClassScore& score) {
        return fmt::format("<oriel.ClassScore tp={} fp={} fn={} f1={:.3f}>", score.true_positives,
                           score.false_positives, score.false_negatives, score.f1());
      });
  py::class_<Miss>(module, "Miss",
                   "One thing that went wrong: an object that was not found, a prediction of "
                   "nothing, or an object that was called something else.")
      .def_readonly("building", &Miss::building)
      .def_readonly("truth_id", &Miss::truth_id)
      .def_readonly("truth_label", &Miss::truth_label)
      .def_readonly("prediction_id", &Miss::prediction_id)
      .def_readonly("prediction_label", &Miss::prediction_label)
      .def_readonly("iou", &Miss::iou)
      .def("__repr__", [](const Miss& miss) {
        return fmt::format("<oriel.Miss in '{}': {} {} called {} {}>", miss.building,
                           miss.truth_label.empty() ? "nothing" : miss.truth_label, miss.truth_id,
                           miss.prediction_label.empty() ? "nothing" : miss.prediction_label,
                           miss.prediction_id);
      });
  py::class_<ScoreReport>(module, "Score",
                          "Labels compared with truth. str() is the table that the command prints.")
      .def_property_readonly(
          "classes", [](const ScoreReport& r) { return r.total.classes; },
          "By label a ClassScore: those of the truth that are scored, and those predicted.")
      .def_property_readonly(
          "macro_f1", [](const ScoreReport& r) { return r.total.macro_f1(); },
          "The mean F1 of the classes that the truth has; NaN if it has none.")
      .def_property_readonly(
          "confusion", [](const ScoreReport& r) { return r.total.confusion; },
          "(label of the truth, predicted label) -> count; '-' stands for nothing.")
      .def_property_readonly(
          "misses", [](const ScoreReport& r) { return r.total.misses; },
          "What went wrong, sorted by building, label and id.")
      .def_property_readonly("by_building", &classes_by_building,
                             "By building and label a ClassScore.")
      .def_property_readonly("intervals", &interval_map,
                             "With bootstrap: (low, high) of F1 by label, and of 'macro_f1'.")
      .def_readonly("issues", &ScoreReport::issues)
      .def_property_readonly("json", &json_of_report, "All of it as JSON, as score --json prints.")
      .def("__str__", &text_of_report)
      .def("__repr__", [](const ScoreReport& r) {
        return fmt::format("<oriel.Score: macro-F1 {:.3f} of {} classes>", r.total.macro_f1(),
                           r.total.classes.size());
      });
  module.def("read_truth", &read_truth_files, Unlocked());
  module.def("score", &score_features, Unlocked());
}

}  // namespace oriel::python
