#include "kernel/solidify/shells/shells.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/base/text/counted.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace oriel {

namespace {

/// What a volume may be off by, as a share of the cones under the facets that it is the sum of.
constexpr double kVolumeError = 1e-12;  // tolerance of doubles

/// 0 if it is no more than rounding, as where all facets lie in one plane.
double volume_of(const Solid& solid, const Shell& shell) {
  double sum = 0, cones = 0;
  for (const FacetId f : shell.facets) {
    const Facet& facet = solid.facets[f.index()];
    const Plane& plane = solid.planes[facet.plane.index()];
    const double cone = plane.offset_m * area_m2(solid.vertices, facet, plane.normal);
    sum += cone;
    cones += std::abs(cone);
  }
  return std::abs(sum) <= kVolumeError * cones ? 0 : sum / 3;
}

/// How often the shell winds around a point: 1 inside an outer shell, 0 outside.
double winding_number(const Solid& solid, const Shell& shell, Vec3 eye) {
  double sum = 0;
  for (const FacetId f : shell.facets)
    sum += winding_part(outlines_of(solid.vertices, solid.facets[f.index()].loops), eye);
  return sum;
}

/// The id of the plane with opposite orientation, added if the solid has none.
PlaneId opposite_plane(Solid& solid, PlaneId id) {
  const Plane turned = exact::opposite(solid.planes[id.index()]);
  const auto found = std::ranges::find_if(solid.planes, [&](const Plane& p) {
    return p.coefficients == turned.coefficients && p.offset == turned.offset;
  });
  if (found != solid.planes.end()) return PlaneId{static_cast<int>(found - solid.planes.begin())};
  solid.planes.push_back(turned);
  return PlaneId{static_cast<int>(solid.planes.size()) - 1};
}

void turn_round(Solid& solid, const Shell& shell) {
  for (const FacetId f : shell.facets) {
    Facet& facet = solid.facets[f.index()];
    facet.plane = opposite_plane(solid, facet.plane);
    for (Loop& loop : facet.loops) std::reverse(loop.begin() + 1, loop.end());
  }
}

/// Only planes that carry a facet stay, sorted as before (descending by normal, then offset).
void renumber_planes(Solid& solid) {
  std::vector<char> is_used(solid.planes.size(), 0);
  for (const Facet& facet : solid.facets) is_used[facet.plane.index()] = 1;
  const auto key = [](const Plane& p) {
    return std::tuple(p.normal.x, p.normal.y, p.normal.z, p.offset_m);
  };
  const auto out_of_order = [&](const Plane& p, const Plane& q) { return key(p) <= key(q); };
  if (std::ranges::find(is_used, 0) == is_used.end() &&
      std::ranges::adjacent_find(solid.planes, out_of_order) == solid.planes.end())
    return;
  std::vector<int> order;
  for (int p = 0; p < std::ssize(solid.planes); ++p)
    if (is_used[at(p)]) order.push_back(p);
  std::ranges::sort(order, std::greater{}, [&](int i) { return key(solid.planes[at(i)]); });
  std::vector<int> number(solid.planes.size(), -1);
  std::vector<Plane> planes;
  for (const int p : order) {
    number[at(p)] = static_cast<int>(planes.size());
    planes.push_back(solid.planes[at(p)]);
  }
  solid.planes = std::move(planes);
  for (Facet& facet : solid.facets) facet.plane = PlaneId{number[facet.plane.index()]};
}

void order_loops(Solid& solid) {
  for (Facet& facet : solid.facets) {
    for (Loop& loop : facet.loops) std::ranges::rotate(loop, std::ranges::min_element(loop));
    if (facet.loops.size() == 1) continue;
    const Vec3 normal = solid.planes[facet.plane.index()].normal;
    std::ranges::sort(facet.loops);
    const auto outer = std::ranges::max_element(facet.loops, {}, [&](const Loop& loop) {
      return signed_area_m2(solid.vertices, loop, normal);
    });
    std::rotate(facet.loops.begin(), outer, outer + 1);
  }
}

}  // namespace

void arrange_shells(Solid& solid, std::span<const int> component,
                    std::span<const ComponentHint> hints, const std::string& building,
                    std::vector<Issue>& issues) {
  ORIEL_ASSERT(component.size() == solid.facets.size());
  ORIEL_ASSERT(std::ranges::all_of(
      component, [&](int c) { return c >= 0 && c < static_cast<int>(hints.size()); }));
  std::vector<Shell> shells(hints.size());
  for (int f = 0; f < std::ssize(solid.facets); ++f)
    shells[at(component[at(f)])].facets.push_back(FacetId{f});

  std::map<int, std::vector<int>> outer_of_body;
  int turned = 0, lumps = 0;
  for (int c = 0; c < std::ssize(shells); ++c) {
    Shell& shell = shells[at(c)];
    if (shell.facets.empty()) continue;
    const double volume = volume_of(solid, shell);
    if (volume == 0) {
      issues.push_back(
          building_issue(Severity::error, Code::E310, building, "a shell encloses no volume"));
      return;
    }
    // Without a word from the input a lone component is an outer shell; of several, those turned
    // inward are cavities.
    const int said = hints[at(c)].shell;
    shell.is_cavity = said > 0 || (said < 0 && volume < 0 && shells.size() > 1);
    if ((volume < 0) != shell.is_cavity) {
      turn_round(solid, shell);
      ++turned;
    }
    if (shell.is_cavity) continue;
    shell.lump = lumps++;
    outer_of_body[hints[at(c)].body].push_back(c);
  }
  if (turned > 0)
    issues.push_back(building_issue(Severity::warning, Code::E308, building,
                                    fmt::format("{} turned inside out (val3dity 405)",
                                                counted(turned, "shell was", "shells were"))));

  for (int c = 0; c < std::ssize(shells); ++c) {
    Shell& shell = shells[at(c)];
    if (!shell.is_cavity || shell.facets.empty()) continue;
    const Vec3 eye = solid.vertices[at(solid.facets[shell.facets[0].index()].loops[0][0])].point;
    const auto& outers = outer_of_body[hints[at(c)].body];
    const auto around = std::ranges::find_if(
        outers, [&](int o) { return winding_number(solid, shells[at(o)], eye) > 0.5; });
    if (around == outers.end()) {
      issues.push_back(building_issue(Severity::error, Code::E305, building,
                                      "an interior shell lies outside its solid (val3dity 403)"));
      return;
    }
    shell.lump = shells[at(*around)].lump;
  }
  std::erase_if(shells, [](const Shell& shell) { return shell.facets.empty(); });
  std::ranges::stable_sort(shells, {},
                           [](const Shell& s) { return std::pair(s.lump, s.is_cavity); });
  solid.shells = std::move(shells);
  arrange_planes_and_loops(solid);
}

void arrange_planes_and_loops(Solid& solid) {
  renumber_planes(solid);
  order_loops(solid);
}

}  // namespace oriel
