#include "interpret/score/surface_score.h"

#include "interpret/surfaces/polygon_shape.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/json_text.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <vector>

#include <fmt/format.h>

namespace oriel {

namespace {

/// What we call a polygon that they call `theirs`: "" if nothing.
std::string our_type(const LabelledBuilding& labelled, int polygon, const std::string& theirs,
                     OpeningPolicy policy) {
  const auto source = static_cast<std::size_t>(polygon);
  if (source >= labelled.surface_of_polygon.size()) return "";
  const int number = labelled.surface_of_polygon[source];
  if (number < 0) return "";
  const SemanticSurface& surface = labelled.surfaces[static_cast<std::size_t>(number)];
  if (!is_opening_type(surface.type) || surface.parent < 0) return surface.type;
  const std::string& around = labelled.surfaces[static_cast<std::size_t>(surface.parent)].type;
  return policy == OpeningPolicy::as_host || around == theirs ? around : surface.type;
}

double ratio(double part, double whole) {
  return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

std::set<std::string> types_of(const SurfaceScore& score) {
  std::set<std::string> types;
  for (const auto& [pair, area] : score.area_m2) {
    types.insert(pair.first);
    types.insert(pair.second);
  }
  types.erase("");
  return types;
}

/// The area that they (first) or we (second) call `type`.
std::pair<double, double> areas_of(const SurfaceScore& score, const std::string& type) {
  std::pair<double, double> areas;
  for (const auto& [pair, area] : score.area_m2) {
    if (pair.first == type) areas.first += area;
    if (pair.second == type) areas.second += area;
  }
  return areas;
}

std::string share_text(double share) {
  return std::isnan(share) ? std::string("-") : fmt::format("{:.4f}", share);
}

}  // namespace

void compare_surfaces(const Building& building, const LabelledBuilding& labelled,
                      const SurfaceTable& surfaces, OpeningPolicy policy, SurfaceScore& score) {
  for (std::size_t row = 0; row < building.polygons.size(); ++row) {
    const Polygon& polygon = building.polygons[row];
    const double area_m2 = surfaces.number(row, SurfaceAttribute::area).value_or(0);
    ++score.polygons;
    if (polygon.hint.empty()) {
      score.unnamed_m2 += area_m2;
      continue;
    }
    if (policy == OpeningPolicy::as_host && is_opening_type(polygon.hint)) {
      score.openings_m2 += area_m2;
      continue;
    }
    const std::string ours = our_type(labelled, polygon.source, polygon.hint, policy);
    score.area_m2[{polygon.hint, ours}] += area_m2;
    if (ours == polygon.hint) continue;
    const Box box = rules::box_of(building, polygon).moved(building.frame.origin_m);
    score.differences.push_back(
        {building.id, polygon.source, polygon.hint, ours, area_m2, 0.5 * (box.min + box.max)});
  }
}

double SurfaceScore::recall(const std::string& type) const {
  double agreed = 0, all = 0;
  for (const auto& [types, area] : area_m2) {
    if (types.first != type) continue;
    all += area;
    if (types.second == type) agreed += area;
  }
  return ratio(agreed, all);
}

double SurfaceScore::precision(const std::string& type) const {
  double agreed = 0, all = 0;
  for (const auto& [types, area] : area_m2) {
    if (types.second != type) continue;
    all += area;
    if (types.first == type) agreed += area;
  }
  return ratio(agreed, all);
}

double SurfaceScore::agreement() const {
  double agreed = 0, all = 0;
  for (const auto& [types, area] : area_m2) {
    all += area;
    if (types.first == types.second) agreed += area;
  }
  return ratio(agreed, all);
}

std::string to_text(const SurfaceScore& score) {
  std::string text = fmt::format("{:<20}{:>13}{:>13}{:>11}{:>9}\n", "surface", "theirs m2",
                                 "ours m2", "precision", "recall");
  for (const std::string& type : types_of(score)) {
    const auto [theirs, ours] = areas_of(score, type);
    text += fmt::format("{:<20}{:>13.2f}{:>13.2f}{:>11}{:>9}\n", printable(type), theirs, ours,
                        share_text(score.precision(type)), share_text(score.recall(type)));
  }
  text += fmt::format("agreement {} of {}", share_text(score.agreement()),
                      counted(score.polygons, "polygon"));
  if (score.openings_m2 > 0)
    text += fmt::format("; {:.2f} m2 of windows and doors left out", score.openings_m2);
  if (score.unnamed_m2 > 0) text += fmt::format("; {:.2f} m2 have no name", score.unnamed_m2);
  text += '\n';
  if (!score.differences.empty()) text += "theirs -> ours\n";
  for (const auto& [pair, area] : score.area_m2)
    if (pair.first != pair.second)
      text += fmt::format("  {:<20} -> {:<20}{:>11.2f} m2\n", printable(pair.first),
                          pair.second.empty() ? "-" : printable(pair.second), area);
  return text;
}

std::string differences_text(const SurfaceScore& score) {
  std::vector<const SurfaceDifference*> sorted;
  for (const SurfaceDifference& d : score.differences) sorted.push_back(&d);
  std::ranges::stable_sort(sorted, std::greater{}, &SurfaceDifference::area_m2);
  std::string text;
  for (const SurfaceDifference* d : sorted)
    text += fmt::format(
        "{}: polygon {} is {}, by the rules {}: {:.2f} m2 at ({:.3f}, {:.3f}, {:.3f})\n",
        printable(d->building), d->polygon, printable(d->theirs),
        d->ours.empty() ? "nothing" : printable(d->ours), d->area_m2, d->place.x, d->place.y,
        d->place.z);
  return text;
}

std::string to_json(const SurfaceScore& score, bool with_differences) {
  std::string classes, confusion;
  for (const std::string& type : types_of(score)) {
    const auto [theirs, ours] = areas_of(score, type);
    classes += fmt::format(R"({}{}:{{"theirs_m2":{},"ours_m2":{},"precision":{},"recall":{}}})",
                           classes.empty() ? "" : ",", json_string(type), json_number(theirs),
                           json_number(ours), json_number(score.precision(type)),
                           json_number(score.recall(type)));
  }
  for (const auto& [pair, area] : score.area_m2)
    confusion +=
        fmt::format(R"({}{{"theirs":{},"ours":{},"area_m2":{}}})", confusion.empty() ? "" : ",",
                    json_string(pair.first), json_string(pair.second), json_number(area));
  std::string differences;
  for (const SurfaceDifference& d : score.differences)
    differences += fmt::format(
        R"({}{{"building":{},"polygon":{},"theirs":{},"ours":{},"area_m2":{},"place":[{},{},{}]}})",
        differences.empty() ? "" : ",", json_string(d.building), d.polygon, json_string(d.theirs),
        json_string(d.ours), json_number(d.area_m2), json_number(d.place.x), json_number(d.place.y),
        json_number(d.place.z));
  std::string text = fmt::format(
      R"({{"surfaces":{{{}}},"agreement":{},"polygons":{},"openings_m2":{},"unnamed_m2":{},"confusion":[{}])",
      classes, json_number(score.agreement()), score.polygons, json_number(score.openings_m2),
      json_number(score.unnamed_m2), confusion);
  if (with_differences) text += fmt::format(R"(,"differences":[{}])", differences);
  return text + "}";
}

}  // namespace oriel
