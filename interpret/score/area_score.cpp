#include "interpret/score/area_score.h"

#include "interpret/surfaces/polygon_shape.h"
#include "kernel/base/text/json_text.h"
#include "kernel/base/text/printable.h"
#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

namespace oriel {

namespace {

bool is_smaller(const LabelledFaces& p, const LabelledFaces& q) {
  return std::tuple(p.faces.size(), p.id) < std::tuple(q.faces.size(), q.id);
}

/// By polygon the smallest object with a label that has it.
std::map<int, const LabelledFaces*> innermost(const std::vector<LabelledFaces>& objects) {
  std::map<int, const LabelledFaces*> by_face;
  for (const LabelledFaces& object : objects) {
    if (object.label.empty()) continue;
    for (const int face : object.faces) {
      const auto [found, is_new] = by_face.try_emplace(face, &object);
      if (!is_new && is_smaller(object, *found->second)) found->second = &object;
    }
  }
  return by_face;
}

/// Files are up to 5 mm off the truth (noise), walls around a niche begin further off.
constexpr double kNicheGrowth_m = 0.02;

/// In the niche of an opening, and not its own.
bool is_reveal(const Building& building, const Polygon& polygon, const FacesOfBuilding& faces,
               const std::string& truth_id) {
  const Box box = rules::box_of(building, polygon).moved(building.frame.origin_m);
  return std::ranges::any_of(faces.niches, [&](const auto& niche) {
    return niche.first != truth_id && is_within(box, grown(niche.second, kNicheGrowth_m));
  });
}

/// Outer ring less holes.
double area_m2(const Building& building, const Polygon& polygon) {
  double area = length(rules::area_vector(building, polygon));
  for (std::size_t hole = 1; hole < polygon.rings.size(); ++hole) {
    Polygon only;
    only.rings = {polygon.rings[hole]};
    area -= length(rules::area_vector(building, only));
  }
  return area;
}

std::string ratio_text(double ratio) {
  return std::isnan(ratio) ? "-" : fmt::format("{:.3f}", ratio);
}

}  // namespace

double AreaScore::macro_f1() const {
  double sum = 0;
  int count = 0;
  for (const auto& [label, area] : classes) {
    if (area.expected_m2 == 0) continue;
    sum += area.f1();
    ++count;
  }
  return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / count;
}

void compare_areas(const Building& building, const FacesOfBuilding& faces,
                   const std::vector<std::string>& not_scored, AreaScore& score) {
  const auto predicted = innermost(faces.predictions);
  const auto expected = innermost(faces.truth);
  for (const Polygon& polygon : building.polygons) {
    const auto truth = expected.find(polygon.source);
    if (truth == expected.end() || std::ranges::count(faces.left_out, polygon.source) > 0) continue;
    if (is_reveal(building, polygon, faces, truth->second->id)) continue;
    const double area = area_m2(building, polygon);
    score.compared_m2 += area;
    const std::string& label = truth->second->label;
    const bool is_scored = std::ranges::count(not_scored, label) == 0;
    const auto said = predicted.find(polygon.source);
    if (is_scored) score.classes[label].expected_m2 += area;
    if (said == predicted.end()) continue;
    score.classes[said->second->label].predicted_m2 += area;
    if (is_scored && said->second->label == label) score.classes[label].both_m2 += area;
  }
}

std::string to_text(const AreaScore& score) {
  std::string text = fmt::format("{:<12} {:>9} {:>9} {:>9} {:>10} {:>7} {:>6}\n", "by area",
                                 "both m2", "ours m2", "true m2", "precision", "recall", "F1");
  for (const auto& [label, area] : score.classes)
    text +=
        fmt::format("{:<12} {:>9.2f} {:>9.2f} {:>9.2f} {:>10} {:>7} {:>6}\n", printable(label),
                    area.both_m2, area.predicted_m2, area.expected_m2, ratio_text(area.precision()),
                    ratio_text(area.recall()), ratio_text(area.f1()));
  return text + fmt::format("macro-F1 by area {}, of {:.2f} m2\n", ratio_text(score.macro_f1()),
                            score.compared_m2);
}

std::string area_json(const AreaScore& score) {
  std::string classes;
  for (const auto& [label, area] : score.classes)
    classes += fmt::format(
        R"({}{}:{{"both_m2":{},"predicted_m2":{},"expected_m2":{},"precision":{},"recall":{},"f1":{}}})",
        classes.empty() ? "" : ",", json_string(label), json_number(area.both_m2),
        json_number(area.predicted_m2), json_number(area.expected_m2),
        json_number(area.precision()), json_number(area.recall()), json_number(area.f1()));
  return fmt::format(R"("area":{{"classes":{{{}}},"macro_f1":{},"compared_m2":{}}})", classes,
                     json_number(score.macro_f1()), json_number(score.compared_m2));
}

}  // namespace oriel
