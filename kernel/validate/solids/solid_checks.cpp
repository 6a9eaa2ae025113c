#include "kernel/validate/solids/solid_checks.h"

#include "kernel/base/assert.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/validate/solids/closed_surface.h"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

std::vector<int> first_vertex(const JudgedShell& shell) {
  return {shell.polygons[0].polygon->rings[0][0]};
}

Subject subject_of(const JudgedShell& shell) { return {shell.body, shell.shell, -1, -1}; }

/// "the exterior shell", "cavity 2".
std::string name_of(const JudgedShell& shell) {
  return shell.shell == 0 ? "the exterior shell" : fmt::format("cavity {}", shell.shell);
}

/// val3dity 405.
bool are_shells_turned_well(const JudgedSolid& solid, const std::deque<ClosedSurface>& surfaces,
                            FindingList& findings) {
  bool is_good = true;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const JudgedShell& shell = *solid.shells[i];
    const bool is_exterior = shell.shell == 0;
    if ((surfaces[i].orientation() > 0) == is_exterior) continue;
    findings.add(Defect::shell_turned, subject_of(shell),
                 fmt::format("the polygons of {} look {}; expected {}", name_of(shell),
                             is_exterior ? "inward" : "outward, into the solid",
                             is_exterior ? "outward" : "into the cavity"),
                 first_vertex(shell));
    is_good = false;
  }
  return is_good;
}

/// How a cavity lies to the exterior shell.
bool lies_inside(const JudgedShell& exterior, const JudgedShell& cavity,
                 const SurfaceRelation& relation, FindingList& findings) {
  const std::string names = fmt::format("{} and {}", name_of(exterior), name_of(cavity));
  if (!relation.do_overlap)
    findings.add(Defect::cavity_outside, subject_of(cavity),
                 fmt::format("{} lies outside the exterior shell", name_of(cavity)),
                 first_vertex(cavity));
  else if (!relation.is_second_inside)
    findings.add(Defect::shells_cross, subject_of(cavity), names + " cross", first_vertex(cavity));
  else if (relation.share_a_face)
    findings.add(Defect::shells_cross, subject_of(cavity), names + " share a face",
                 first_vertex(cavity));
  else
    return true;
  return false;
}

/// How two cavities lie to each other.
bool lie_apart(const JudgedShell& p, const JudgedShell& q, const SurfaceRelation& relation,
               FindingList& findings) {
  const std::string names = fmt::format("{} and {}", name_of(p), name_of(q));
  if (relation.are_alike)
    findings.add(Defect::shells_alike, subject_of(q), names + " are the same", first_vertex(q));
  else if (relation.do_overlap)
    findings.add(Defect::shells_cross, subject_of(q), names + " overlap", first_vertex(q));
  else if (relation.share_a_face)
    findings.add(Defect::shells_cross, subject_of(q), names + " share a face", first_vertex(q));
  else
    return true;
  return false;
}

/// The triangles of a surface, sorted: the same for surfaces given twice.
std::vector<MicrometreTriangle> sorted_triangles(const ClosedSurface& surface) {
  std::vector<MicrometreTriangle> triangles = surface.triangles();
  for (MicrometreTriangle& triangle : triangles)
    std::ranges::rotate(triangle, std::ranges::min_element(triangle));
  std::ranges::sort(triangles);
  return triangles;
}

/// Calls tell(i, j) for each surface j that is given before, as i; false if there is one. Bodies
/// listed a thousand times over are found before any two are compared.
template <class Tell>
bool are_given_once(const std::deque<ClosedSurface>& surfaces, std::size_t from, const Tell& tell) {
  std::map<std::vector<MicrometreTriangle>, std::size_t> first_of;
  bool are_once = true;
  for (std::size_t j = from; j < surfaces.size(); ++j) {
    const auto [first, is_new] = first_of.try_emplace(sorted_triangles(surfaces[j]), j);
    if (is_new) continue;
    tell(first->second, j);
    are_once = false;
  }
  return are_once;
}

bool do_shells_lie_well(const JudgedSolid& solid, const std::deque<ClosedSurface>& surfaces,
                        FindingList& findings) {
  const bool are_once = are_given_once(surfaces, 1, [&](std::size_t i, std::size_t j) {
    SurfaceRelation alike;
    alike.are_alike = true;
    lie_apart(*solid.shells[i], *solid.shells[j], alike, findings);
  });
  if (!are_once) return false;
  const std::size_t before = findings.size();
  bool do_touch = false;
  for (std::size_t i = 1; i < surfaces.size(); ++i) {
    const SurfaceRelation relation = relate(surfaces[0], surfaces[i], findings.work());
    if (findings.is_used_up()) return false;
    do_touch = do_touch || relation.do_touch;
    lies_inside(*solid.shells[0], *solid.shells[i], relation, findings);
  }
  for (std::size_t i = 1; i < surfaces.size(); ++i)
    for (std::size_t j = i + 1; j < surfaces.size(); ++j) {
      if (!overlap(surfaces[i].box(), surfaces[j].box())) continue;
      const SurfaceRelation relation = relate(surfaces[i], surfaces[j], findings.work());
      if (findings.is_used_up()) return false;
      do_touch = do_touch || relation.do_touch;
      lie_apart(*solid.shells[i], *solid.shells[j], relation, findings);
    }
  if (findings.size() > before) return false;
  if (!do_touch) return true;
  std::vector<const ClosedSurface*> cavities;
  for (std::size_t i = 1; i < surfaces.size(); ++i) cavities.push_back(&surfaces[i]);
  const int pieces = count_pieces(surfaces[0], cavities, findings.work());
  if (findings.is_used_up()) return false;
  if (pieces == 1) return true;
  findings.add(Defect::solid_in_pieces, {solid.body, -1, -1, -1},
               fmt::format("its cavities divide the interior into {} pieces", pieces),
               first_vertex(*solid.shells[0]));
  return false;
}

}  // namespace

bool judge(const SnappedBuilding& building, const JudgedSolid& solid, FindingList& findings) {
  ORIEL_ASSERT(!solid.shells.empty());
  std::deque<ClosedSurface> surfaces;
  for (const JudgedShell* shell : solid.shells) surfaces.emplace_back(building, *shell);
  if (!are_shells_turned_well(solid, surfaces, findings)) return false;
  return surfaces.size() == 1 || do_shells_lie_well(solid, surfaces, findings);
}

bool judge_composite(const SnappedBuilding& building, std::span<const JudgedSolid> solids,
                     FindingList& findings) {
  std::deque<ClosedSurface> surfaces;
  for (const JudgedSolid& solid : solids) surfaces.emplace_back(building, *solid.shells[0]);
  const std::size_t before = findings.size();
  const auto tell = [&](Defect defect, std::size_t p, std::size_t q, const char* what) {
    findings.add(defect, {solids[q].body, -1, -1, -1},
                 fmt::format("solids {} and {} {}", solids[p].body, solids[q].body, what),
                 first_vertex(*solids[q].shells[0]));
  };
  const bool are_once = are_given_once(surfaces, 0, [&](std::size_t i, std::size_t j) {
    tell(Defect::solids_alike, i, j, "are the same");
  });
  if (!are_once) return false;
  struct BodyPair {
    std::size_t p, q;
    SurfaceRelation relation;
  };
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (std::size_t j = i + 1; j < surfaces.size(); ++j)
      if (overlap(surfaces[i].box(), surfaces[j].box()))
        pairs.push_back({i, j, relate(surfaces[i], surfaces[j], findings.work())});
  if (findings.is_used_up()) return false;
  for (const BodyPair& pair : pairs)
    if (pair.relation.are_alike) tell(Defect::solids_alike, pair.p, pair.q, "are the same");
  if (findings.size() > before) return false;
  for (const BodyPair& pair : pairs)
    if (pair.relation.do_overlap) tell(Defect::solids_cross, pair.p, pair.q, "overlap");
  if (findings.size() > before) return false;
  DisjointSets joined(solids.size());
  for (const BodyPair& pair : pairs)
    if (pair.relation.share_a_face)
      joined.unite(static_cast<int>(pair.p), static_cast<int>(pair.q));
  for (std::size_t i = 1; i < solids.size(); ++i)
    if (joined.find(static_cast<int>(i)) == static_cast<int>(i))
      findings.add(
          Defect::solids_apart, {solids[i].body, -1, -1, -1},
          fmt::format("solid {} is not joined by a face to the solids before it", solids[i].body),
          first_vertex(*solids[i].shells[0]));
  return findings.size() == before;
}

}  // namespace oriel::detail
