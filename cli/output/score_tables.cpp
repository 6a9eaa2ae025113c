#include "cli/output/score_tables.h"

#include "kernel/io/records/feature_records.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

std::string cell_of(double ratio) { return std::isnan(ratio) ? "" : fmt::format("{}", ratio); }

void append_row(std::string& out, std::string first, std::string second, const ClassScore& counts) {
  append_csv_line(out,
                  {std::move(first), std::move(second), std::to_string(counts.true_positives),
                   std::to_string(counts.false_positives), std::to_string(counts.false_negatives),
                   cell_of(counts.precision()), cell_of(counts.recall()), cell_of(counts.f1())});
}

}  // namespace

std::string per_building_csv(const std::map<std::string, Score>& buildings) {
  std::string text = "building,class,tp,fp,fn,precision,recall,f1\n";
  for (const auto& [building, score] : buildings) {
    ClassScore all;
    for (const auto& [label, counts] : score.classes) {
      append_row(text, building, label, counts);
      all += counts;
    }
    append_row(text, building, "all", all);
  }
  return text;
}

std::string curve_csv(const std::vector<CurvePoint>& curve) {
  std::vector<const CurvePoint*> points;
  points.reserve(curve.size());
  for (const CurvePoint& point : curve) points.push_back(&point);
  std::ranges::stable_sort(points, {}, [](const CurvePoint* point) { return point->label; });
  std::string text = "class,threshold,tp,fp,fn,precision,recall,f1\n";
  for (const CurvePoint* point : points)
    append_row(text, point->label, fmt::format("{}", point->threshold), point->counts);
  return text;
}

std::string joined_csv(const std::vector<ObjectMatch>& matches) {
  std::string text = "building,feature,name,label,score,rule,truth,class,iou,outcome\n";
  const Prediction no_prediction;
  const ExpectedObject no_object;
  for (const ObjectMatch& match : matches) {
    const Prediction& found = match.prediction ? *match.prediction : no_prediction;
    const ExpectedObject& object = match.truth ? *match.truth : no_object;
    append_csv_line(
        text, {match.truth ? object.building : found.building, found.id, found.name, found.label,
               found.label.empty() ? "" : fmt::format("{}", found.score), found.rule, object.id,
               object.label, match.iou > 0 ? fmt::format("{}", match.iou) : "",
               to_string(match.outcome)});
  }
  return text;
}

}  // namespace oriel::cli
