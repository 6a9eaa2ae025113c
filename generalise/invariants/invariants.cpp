#include "generalise/invariants/invariants.h"

#include "generalise/removal/facets.h"
#include "kernel/base/index.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/directions.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/shared_area.h"
#include "model/tolerances.h"
#include "model/vec3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// `what`: "the volume would change".
Violation beyond_limit(std::string_view what, double by, double limit, std::string_view unit) {
  return {Code::G405,
          fmt::format("{} by {:.3g} {}, more than {:g} {}", what, by, unit, limit, unit)};
}

/// What changed by more percent than it may.
std::optional<Violation> changed(std::string_view what, double before, double after,
                                 std::optional<double> limit_pct) {
  const double by_pct = before > 0 ? 100 * std::abs(after - before) / before : 0;
  if (!limit_pct || by_pct <= *limit_pct) return std::nullopt;
  return beyond_limit(what, by_pct, *limit_pct, "%");
}

/// Of the lines at their main height less than half is left there.
std::optional<Violation> lost(std::string_view what, const std::vector<LevelLine>& before,
                              const std::vector<LevelLine>& after, std::optional<double> within_m) {
  const auto height_m = within_m ? main_height_m(before) : std::nullopt;
  if (!height_m ||
      length_near_m(after, *height_m, *within_m) >= length_near_m(before, *height_m, *within_m) / 2)
    return std::nullopt;
  return Violation{Code::G405, fmt::format("its {} would move by more than {} m", what, *within_m)};
}

double shared_m2(const Solid& solid, const PartyWall& wall) {
  double sum_m2 = 0;
  for (const Facet& facet : solid.facets) {
    const Plane& plane = solid.planes[facet.plane.index()];
    if (length(plane.normal + wall.normal) > kPartyWallLean) continue;
    const auto distance_m = [&](Vec3 p) { return std::abs(dot(plane.normal, p) - plane.offset_m); };
    const bool is_near = std::ranges::all_of(wall.outlines[0],
                                             [&](Vec3 p) { return distance_m(p) <= kPartyWall_m; });
    if (!is_near) continue;
    sum_m2 += shared_area_m2(outlines_of(solid.vertices, facet.loops), wall.outlines, wall.normal);
  }
  return sum_m2;
}

PartyWall wall_of(const Building& building, const Polygon& polygon, Vec3 moved_m) {
  PartyWall wall{outlines_of(building, polygon), {}};
  for (Outline& outline : wall.outlines)
    for (Vec3& p : outline) p = p + moved_m;
  wall.normal = normalised(area_vector(wall.outlines[0]));
  return wall;
}

bool is_beside(const PartyWall& wall, const Box& box) {
  Box its;
  for (const Vec3 p : wall.outlines[0]) its.grow(p);
  return overlap(its, box);
}

/// The steepest slope of an edge that is level, and of a facet that neither rises nor falls: planes
/// through noisy points are level to some millimetres.
constexpr double kLevel = 0.01;
/// Lines of one height: noise moves them by millimetres.
constexpr double kOneHeight_m = 0.01;

enum class RoofSide { none, falls, level, rises };

/// How a roof facet goes on inwards from its edge from `p` to `q`; none: it is no roof.
RoofSide side_of(const Plane& plane, Vec3 p, Vec3 q) {
  if (!looks_up(plane.normal)) return RoofSide::none;
  const double rise = cross(plane.normal, normalised(q - p)).z;
  return rise > kLevel ? RoofSide::rises : rise < -kLevel ? RoofSide::falls : RoofSide::level;
}

bool is_level(Vec3 p, Vec3 q) {
  const Vec3 along = q - p;
  return std::abs(along.z) <= kLevel * length(along);
}

std::optional<Violation> pieces(const Measures& before, const Measures& after,
                                const Limits& /*limits*/) {
  return falls_apart(before, after);
}

std::optional<Violation> overhang(const Measures& before, const Measures& after,
                                  const Limits& limits) {
  const double hanging_m2 = after.overhang_m2 - before.overhang_m2;
  if (!limits.overhang_pct || hanging_m2 <= *limits.overhang_pct / 100 * before.footprint_m2)
    return std::nullopt;
  return Violation{Code::G411, fmt::format("{:.2f} m2 would hang in the air", hanging_m2)};
}

std::optional<Violation> box(const Measures& before, const Measures& after, const Limits& limits) {
  return limits.overhang_pct ? reaches_out(before, after, kBoxSlack_m) : std::nullopt;
}

std::optional<Violation> footprint(const Measures& before, const Measures& after,
                                   const Limits& limits) {
  return changed("the footprint would change", before.footprint_m2, after.footprint_m2,
                 limits.footprint_pct);
}

std::optional<Violation> volume(const Measures& before, const Measures& after,
                                const Limits& limits) {
  return changed("the volume would change", before.volume_m3, after.volume_m3, limits.volume_pct);
}

std::optional<Violation> party_wall(const Measures& before, const Measures& after,
                                    const Limits& limits) {
  return changed("its party walls would change", before.party_walls_m2, after.party_walls_m2,
                 limits.party_walls_pct);
}

std::optional<Violation> top(const Measures& before, const Measures& after, const Limits& limits) {
  const double top_m = std::abs(after.box.max.z - before.box.max.z);
  if (!limits.top_m || top_m <= *limits.top_m) return std::nullopt;
  return beyond_limit("its highest point would move", top_m, *limits.top_m, "m");
}

std::optional<Violation> ridge(const Measures& before, const Measures& after,
                               const Limits& limits) {
  return lost("ridge", before.roof.ridges, after.roof.ridges, limits.ridge_m);
}

std::optional<Violation> eaves(const Measures& before, const Measures& after,
                               const Limits& limits) {
  return lost("eaves", before.roof.eaves, after.roof.eaves, limits.eaves_m);
}

constexpr std::array kInvariants{
    Invariant{"pieces", pieces}, Invariant{"overhang", overhang},
    Invariant{"box", box},       Invariant{"footprint", footprint},
    Invariant{"volume", volume}, Invariant{"party walls", party_wall},
    Invariant{"top", top},       Invariant{"ridge", ridge},
    Invariant{"eaves", eaves},
};

}  // namespace

Measures measures_of(const Solid& solid, const Invariants& invariants) {
  Measures out;
  for (const Shell& shell : solid.shells) out.lumps = std::max(out.lumps, shell.lump + 1);
  out.volume_m3 = volume_m3(solid);
  const Box box = out.box = box_of(solid);
  for (const Facet& facet : solid.facets) {
    const Plane& plane = solid.planes[facet.plane.index()];
    if (plane.coefficients[2] >= 0) continue;
    const bool is_low = std::ranges::all_of(facet.loops[0], [&](int v) {
      return solid.vertices[static_cast<std::size_t>(v)].point.z <= box.min.z + kGroundReach_m;
    });
    (is_low ? out.footprint_m2 : out.overhang_m2) -=
        plane.normal.z * area_m2(solid.vertices, facet, plane.normal);
  }
  if (invariants.limits.ridge_m || invariants.limits.eaves_m) out.roof = roof_lines(solid);
  out.party_walls_m2 = shared_m2(solid, invariants.party_walls);
  return out;
}

std::span<const Invariant> all_invariants() { return kInvariants; }

std::optional<Violation> violation(const Measures& before, const Measures& after,
                                   const Invariants& invariants) {
  for (const Invariant& one : kInvariants)
    if (auto broken = one.violation(before, after, invariants.limits)) return broken;
  return std::nullopt;
}

Violation fallen_apart() { return {Code::G411, "the building would fall apart"}; }

std::optional<Violation> falls_apart(const Measures& before, const Measures& after) {
  if (after.lumps <= before.lumps) return std::nullopt;
  return fallen_apart();
}

std::optional<Violation> reaches_out(const Measures& before, const Measures& after,
                                     double slack_m) {
  const Vec3 slack{slack_m, slack_m, slack_m};
  Box both{before.box.min - slack, before.box.max + slack};
  const Box grown = both;
  both.grow(after.box);
  if (both == grown) return std::nullopt;
  return Violation{Code::G412, "the building would reach further than it did"};
}

std::vector<PartyWall> party_walls(const Building& building, const Solid& solid,
                                   std::span<const Building> buildings) {
  const Box near = grown(box_of(solid), kPartyWall_m);
  std::vector<PartyWall> walls;
  for (const Building& other : buildings) {
    if (other.id == building.id) continue;
    const Vec3 moved_m = other.frame.origin_m - building.frame.origin_m;
    for (const Polygon& polygon : other.polygons) {
      PartyWall wall = wall_of(other, polygon, moved_m);
      if (std::abs(wall.normal.z) > kPartyWallLean || !is_beside(wall, near)) continue;
      if (shared_m2(solid, wall) > kPartyWall_m2) walls.push_back(std::move(wall));
    }
  }
  return walls;
}

double shared_m2(const Solid& solid, const std::vector<PartyWall>& walls) {
  double sum_m2 = 0;
  for (const PartyWall& wall : walls) sum_m2 += shared_m2(solid, wall);
  return sum_m2;
}

RoofLines roof_lines(const Solid& solid) {
  std::map<std::pair<int, int>, int> facet_at;
  detail::for_each_edge(solid, [&](int facet, int p, int q) { facet_at[{p, q}] = facet; });
  RoofLines out;
  for (const auto& [edge, facet] : facet_at) {
    const Vec3 p = solid.vertices[at(edge.first)].point, q = solid.vertices[at(edge.second)].point;
    const auto across = facet_at.find({edge.second, edge.first});
    if (across == facet_at.end() || !is_level(p, q)) continue;
    const auto plane = [&](int f) { return solid.planes[solid.facets[at(f)].plane.index()]; };
    const RoofSide mine = side_of(plane(facet), p, q), other = side_of(plane(across->second), q, p);
    const LevelLine line{(p.z + q.z) / 2, length(q - p)};
    const bool is_counted = other != RoofSide::none && edge.second < edge.first;  // from across
    if ((mine == RoofSide::rises || mine == RoofSide::level) && other == RoofSide::none)
      out.eaves.push_back(line);
    else if (mine == RoofSide::falls && (other == RoofSide::none || other == RoofSide::falls) &&
             !is_counted)
      out.ridges.push_back(line);
  }
  return out;
}

std::optional<double> main_height_m(const std::vector<LevelLine>& lines) {
  std::vector<LevelLine> sorted = lines;
  std::ranges::stable_sort(sorted, {}, &LevelLine::height_m);
  std::optional<double> best;
  double most_m = 0;
  for (const LevelLine& line : sorted) {
    const double length_m = length_near_m(sorted, line.height_m, kOneHeight_m);
    if (length_m < most_m) continue;
    most_m = length_m;
    best = line.height_m;
  }
  return best;
}

double length_near_m(const std::vector<LevelLine>& lines, double height_m, double within_m) {
  double length_m = 0;
  for (const LevelLine& line : lines)
    if (std::abs(line.height_m - height_m) <= within_m) length_m += line.length_m;
  return length_m;
}

}  // namespace oriel
