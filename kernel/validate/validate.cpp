#include "kernel/validate/validate.h"

#include "kernel/validate/defects.h"
#include "kernel/validate/polygons/polygon_checks.h"
#include "kernel/validate/polygons/snapped.h"
#include "kernel/validate/proof/valid_solid.h"
#include "kernel/validate/solids/closed_surface.h"
#include "kernel/validate/solids/shell_checks.h"
#include "kernel/validate/solids/solid_checks.h"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using detail::FindingList;
using detail::JudgedShell;
using detail::SnappedBuilding;
using detail::SnapTies;

/// What the rings of a polygon and its triangles take, but for edges whose boxes overlap.
constexpr std::int64_t kStepsPerCorner = 16;

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
      for (const auto& ring : polygon->rings) findings.count(kStepsPerCorner * std::ssize(ring));
      if (findings.is_used_up()) return shells;
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
      if (findings.is_used_up()) return {{}, false};
      if (shell) solid.shells.push_back(&*shell);
    }
    is_good = is_good && detail::judge(building, solid, findings);
    out.are_all_good = out.are_all_good && is_good;
    if (is_good) out.solids.push_back(std::move(solid));
  }
  return out;
}

/// All parts as the solids of one building, in the frame of the first, and which part each solid is
/// of.
struct JoinedParts {
  Building building;
  std::vector<std::size_t> part_of;
};

JoinedParts joined(std::span<const Building* const> parts) {
  JoinedParts out;
  out.building.frame = parts[0]->frame;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Building part = without_installations(*parts[p]);
    const Vec3 shift = part.frame.origin_m - out.building.frame.origin_m;
    const int first_vertex = static_cast<int>(out.building.vertices.size());
    const int first_body = static_cast<int>(out.part_of.size());
    for (const Vec3 v : part.vertices) out.building.vertices.push_back(v + shift);
    for (Polygon polygon : part.polygons) {
      for (std::vector<int>& ring : polygon.rings)
        for (int& vertex : ring) vertex += first_vertex;
      polygon.body += first_body;
      out.part_of.resize(std::max(out.part_of.size(), static_cast<std::size_t>(polygon.body) + 1),
                         p);
      out.building.polygons.push_back(std::move(polygon));
    }
  }
  return out;
}

/// The bodies of a solid: that of its outer shell, then those of its cavities.
std::vector<std::deque<detail::ClosedSurface>> surfaces_of(
    const SnappedBuilding& building, const std::vector<detail::JudgedSolid>& solids) {
  std::vector<std::deque<detail::ClosedSurface>> out;
  for (const detail::JudgedSolid& solid : solids) {
    out.emplace_back();
    for (const JudgedShell* shell : solid.shells) out.back().emplace_back(building, *shell);
  }
  return out;
}

/// True if `body` has no point outside one of the cavities of `host`.
bool is_in_cavity(const std::deque<detail::ClosedSurface>& host, const detail::ClosedSurface& body,
                  Work& work) {
  for (std::size_t i = 1; i < host.size(); ++i)
    if (relate(host[i], body, work).is_second_inside) return true;
  return false;
}

bool do_solids_overlap(const std::deque<detail::ClosedSurface>& p,
                       const std::deque<detail::ClosedSurface>& q, Work& work) {
  if (!overlap(p[0].box(), q[0].box())) return false;
  const detail::SurfaceRelation relation = relate(p[0], q[0], work);
  return (relation.do_overlap || relation.are_alike) && !is_in_cavity(p, q[0], work) &&
         !is_in_cavity(q, p[0], work);
}

Finding not_all_judged(std::int64_t budget) {
  Finding finding;
  finding.code = Code::E502;
  finding.sentence = fmt::format(
      "validating used up the work budget of {} steps; the rest is not checked", budget);
  return finding;
}

/// What was found, and whether that may not be all.
std::vector<Finding> all_of(FindingList& findings, std::int64_t budget) {
  const bool is_used_up = findings.is_used_up();
  std::vector<Finding> found = findings.take();
  if (is_used_up) found.push_back(not_all_judged(budget));
  return found;
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

std::vector<Finding> validate(const Building& building, const SnappedBuilding& snapped,
                              const ValidateOptions& options) {
  const bool is_solid = is_judged_as_solid(building, options.primitive);
  if (is_solid && !building.is_composite && detail::is_surely_valid_solid(snapped, options))
    return {};
  FindingList findings(snapped, options.budget);
  if (building.polygons.empty()) findings.add(detail::Defect::empty, {}, "it has no polygons");
  const JudgedShells shells = judge_polygons(snapped, options, findings);
  if (findings.is_used_up()) return all_of(findings, options.budget);
  if (is_solid) {
    const JudgedSolids judged = judge_shells(snapped, shells, findings);
    if (judged.are_all_good && building.is_composite)
      detail::judge_composite(snapped, judged.solids, findings);
  } else if (building.is_composite && options.primitive != ValidateOptions::Primitive::surfaces) {
    for (const auto& [place, shell] : shells)
      if (shell) detail::judge(snapped, *shell, true, findings);
  }
  return all_of(findings, options.budget);
}

bool have_same_vertices(const SnappedBuilding& p, const SnappedBuilding& q) {
  return std::ranges::equal(p.polygons, q.polygons, {}, &detail::SnappedPolygon::rings,
                            &detail::SnappedPolygon::rings);
}

/// It has two triangles at most, which are compared in any case.
bool has_few_triangles(const detail::SnappedPolygon& polygon) {
  constexpr std::size_t kCornersOfTwo = 4;
  return polygon.rings.size() == 1 && polygon.rings[0].size() <= kCornersOfTwo;
}

/// Where polygons without other findings are folded between any two of their triangles.
std::vector<Finding> folds_in(const SnappedBuilding& snapped, const ValidateOptions& options) {
  FindingList findings(snapped);
  for (const detail::SnappedPolygon& polygon : snapped.polygons)
    if (!has_few_triangles(polygon))
      detail::judge(snapped, polygon, options, findings, detail::FoldsBetween::any_two);
  return findings.take();
}

/// The findings of any judge.
std::vector<Finding> validate_for_any(const Building& building, const ValidateOptions& options) {
  const auto as_one = detail::snapped(building, options.snap_m, SnapTies::one);
  if (!as_one) return {out_of_range(building)};
  if (as_one->are_all_apart && is_judged_as_solid(building, options.primitive) &&
      !building.is_composite && detail::is_surely_valid_solid(*as_one, options))
    return {};
  const auto as_two = detail::snapped(building, options.snap_m, SnapTies::two);
  auto findings = validate(building, *as_two, options);
  if (findings.empty()) findings = folds_in(*as_two, options);
  if (findings.empty() && !have_same_vertices(*as_one, *as_two))
    findings = validate(building, *as_one, options);
  return findings;
}

}  // namespace

std::vector<Finding> validate(const Building& building, const ValidateOptions& options) {
  if (!building.installations.empty()) return validate(without_installations(building), options);
  if (options.judge == ValidateOptions::Judge::any) return validate_for_any(building, options);
  const auto snapped = detail::snapped(building, options.snap_m, SnapTies::as_computed);
  return snapped ? validate(building, *snapped, options) : std::vector{out_of_range(building)};
}

std::vector<PartOverlap> overlapping_parts(std::span<const Building* const> parts,
                                           const ValidateOptions& options) {
  if (parts.size() < 2) return {};
  const JoinedParts all = joined(parts);
  const auto snapped = detail::snapped(all.building, options.snap_m, SnapTies::as_computed);
  if (!snapped) return {};
  FindingList unheard(*snapped, options.budget), findings(*snapped, options.budget);
  const JudgedShells shells = judge_polygons(*snapped, options, unheard);
  const JudgedSolids judged = judge_shells(*snapped, shells, unheard);
  const auto surfaces = surfaces_of(*snapped, judged.solids);
  const auto part_of = [&](std::size_t solid) {
    return all.part_of[static_cast<std::size_t>(judged.solids[solid].body)];
  };
  std::set<std::pair<std::size_t, std::size_t>> told;
  std::vector<PartOverlap> overlaps;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (std::size_t j = i + 1; j < surfaces.size(); ++j) {
      const std::pair pair(part_of(i), part_of(j));
      if (pair.first == pair.second || told.contains(pair) ||
          !do_solids_overlap(surfaces[i], surfaces[j], findings.work()))
        continue;
      told.insert(pair);
      findings.add(detail::Defect::parts_overlap, {},
                   fmt::format("it overlaps {} of the same building", parts[pair.first]->id),
                   {judged.solids[j].shells[0]->polygons[0].polygon->rings[0][0]});
      overlaps.push_back({pair.second, {}});
    }
  std::vector<Finding> found = findings.take();
  for (std::size_t i = 0; i < overlaps.size(); ++i) overlaps[i].finding = std::move(found[i]);
  return overlaps;
}

}  // namespace oriel
