#include "kernel/validate/validate.h"

#include "kernel/validate/defects.h"
#include "kernel/validate/polygons/polygon_checks.h"
#include "kernel/validate/polygons/snapped.h"
#include "kernel/validate/solids/shell_checks.h"
#include "kernel/validate/solids/solid_checks.h"

#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using detail::FindingList;
using detail::JudgedShell;
using detail::SnappedBuilding;

bool is_judged_as_solid(const Building& building, ValidateOptions::Primitive primitive) {
  if (primitive == ValidateOptions::Primitive::as_stated) return building.is_solid;
  return primitive == ValidateOptions::Primitive::solid;
}

/// The shells of a building in order, by body and shell; nothing for one with a bad polygon.
using JudgedShells = std::map<std::pair<int, int>, std::optional<JudgedShell>>;

JudgedShells judge_polygons(const SnappedBuilding& building, const ValidateOptions& options,
                            FindingList& findings) {
  // Findings come in the order of shells, whatever order the polygons are listed in.
  std::map<std::pair<int, int>, std::vector<const detail::SnappedPolygon*>> members;
  for (const detail::SnappedPolygon& polygon : building.polygons)
    members[{polygon.body, polygon.shell}].push_back(&polygon);
  JudgedShells shells;
  for (const auto& [place, polygons] : members) {
    JudgedShell shell{place.first, place.second, {}};
    bool is_good = true;
    for (const detail::SnappedPolygon* polygon : polygons) {
      auto judged = detail::judge(building, *polygon, options, findings);
      is_good = is_good && judged.is_good;
      shell.polygons.push_back({polygon, std::move(judged.triangles)});
    }
    shells.emplace(place, is_good ? std::optional(std::move(shell)) : std::nullopt);
  }
  return shells;
}

/// The solids of which all shells are good, in order; `are_all_good` if that is all of them.
struct JudgedSolids {
  std::vector<detail::JudgedSolid> solids;
  bool are_all_good = true;
};

JudgedSolids judge_shells(const SnappedBuilding& building, const JudgedShells& shells,
                          FindingList& findings) {
  JudgedSolids out;
  for (auto at = shells.begin(); at != shells.end();) {
    const int body = at->first.first;
    detail::JudgedSolid solid{body, {}};
    bool is_good = true;
    for (; at != shells.end() && at->first.first == body; ++at) {
      const auto& shell = at->second;
      is_good = shell && detail::judge(building, *shell, false, findings) && is_good;
      if (shell) solid.shells.push_back(&*shell);
    }
    is_good = is_good && detail::judge(building, solid, findings);
    out.are_all_good = out.are_all_good && is_good;
    if (is_good) out.solids.push_back(std::move(solid));
  }
  return out;
}

Finding out_of_range(const Building& building) {
  Finding finding;
  finding.code = Code::E506;
  finding.sentence = fmt::format(
      "a coordinate of its {} vertices is not finite, or further than "
      "4.2 km from the building's origin",
      building.vertices.size());
  return finding;
}

}  // namespace

std::vector<Finding> validate(const Building& building, const ValidateOptions& options) {
  if (!building.installations.empty()) return validate(without_installations(building), options);
  const auto snapped = detail::snapped(building, options.snap_m);
  if (!snapped) return {out_of_range(building)};
  FindingList findings(*snapped);
  if (building.polygons.empty()) findings.add(detail::Defect::empty, {}, "it has no polygons");
  const JudgedShells shells = judge_polygons(*snapped, options, findings);
  if (is_judged_as_solid(building, options.primitive)) {
    const JudgedSolids judged = judge_shells(*snapped, shells, findings);
    if (judged.are_all_good && building.is_composite)
      detail::judge_composite(*snapped, judged.solids, findings);
  } else if (building.is_composite && options.primitive != ValidateOptions::Primitive::surfaces) {
    for (const auto& [place, shell] : shells)
      if (shell) detail::judge(*snapped, *shell, true, findings);
  }
  return findings.take();
}

}  // namespace oriel
