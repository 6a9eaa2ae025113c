#include "generalise/invariants/roof_lines.h"

#include "generalise/removal/facets.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace oriel {

namespace {

/// The steepest slope of an edge that is level, and of a facet that neither rises nor falls: planes
/// through noisy points are level to some millimetres.
constexpr double kLevel = 0.01;
/// Lines of one height: noise moves them by millimetres.
constexpr double kOneHeight_m = 0.01;

enum class RoofSide { none, falls, level, rises };

/// How a roof facet goes on inwards from its edge from `p` to `q`; none: it is no roof.
RoofSide side_of(const Plane& plane, Vec3 p, Vec3 q) {
  if (!detail::looks_up(plane.normal)) return RoofSide::none;
  const double rise = cross(plane.normal, normalised(q - p)).z;
  return rise > kLevel ? RoofSide::rises : rise < -kLevel ? RoofSide::falls : RoofSide::level;
}

bool is_level(Vec3 p, Vec3 q) {
  const Vec3 along = q - p;
  return std::abs(along.z) <= kLevel * length(along);
}

}  // namespace

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
