#include "kernel/validate/polygons/polygon_checks.h"

#include "kernel/mesh/triangulate.h"
#include "kernel/validate/polygons/fitted_plane.h"
#include "kernel/validate/polygons/ring_checks.h"
#include "model/vec3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <span>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

Subject subject_of(const SnappedPolygon& polygon) {
  return {polygon.body, polygon.shell, polygon.number, -1};
}

/// The vertex furthest from the fitted plane, if it is too far.
bool is_near_plane(const SnappedBuilding& building, const SnappedPolygon& polygon,
                   const FittedPlane& plane, double tolerance_m, FindingList& findings) {
  double furthest = -1;
  int where = -1;
  for (const auto& ring : polygon.rings)
    for (const int vertex : ring) {
      const double distance = std::abs(plane.distance(building.metres(vertex)));
      if (distance <= furthest) continue;
      furthest = distance;
      where = vertex;
    }
  if (furthest <= tolerance_m) return true;
  findings.add(Defect::off_plane, subject_of(polygon),
               fmt::format("polygon {} is not planar: a point is {:.4f} m from the plane fitted to "
                           "it; the tolerance is {} m",
                           polygon.number, furthest, tolerance_m),
               {where});
  return false;
}

using CornersOfTriangle = std::array<int, 3>;

/// The corners of a polygon once each, in micrometres, and its rings as numbers of these.
struct LocalPolygon {
  std::vector<int> vertices;
  std::vector<Vec3> points;
  std::vector<std::vector<int>> rings;
};

LocalPolygon local_polygon(const SnappedBuilding& building, const SnappedPolygon& polygon) {
  LocalPolygon local{{}, {}, polygon.rings};
  std::map<int, int> local_of;
  for (auto& ring : local.rings)
    for (int& vertex : ring) {
      const auto [found, is_new] =
          local_of.try_emplace(vertex, static_cast<int>(local.vertices.size()));
      if (is_new) {
        const MicrometrePoint& p = building.point(vertex);
        local.vertices.push_back(vertex);
        local.points.push_back(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
      }
      vertex = found->second;
    }
  return local;
}

/// The triangles of a polygon whose rings are good: in the fitted plane, as val3dity has them.
/// Those along the axis instead where rounding in that plane makes one of corners on a line.
std::vector<CornersOfTriangle> triangles_of(const SnappedBuilding& building,
                                            const SnappedPolygon& polygon, Vec3 axis) {
  const LocalPolygon local = local_polygon(building, polygon);
  const auto in_building = [&](std::vector<CornersOfTriangle> triangles) {
    for (auto& triangle : triangles)
      for (int& corner : triangle) corner = local.vertices[static_cast<std::size_t>(corner)];
    return triangles;
  };
  auto triangles = in_building(triangulate_in_plane(local.points, local.rings));
  const bool is_good = std::ranges::none_of(triangles, [&](const CornersOfTriangle& t) {
    return are_collinear(building.point(t[0]), building.point(t[1]), building.point(t[2]));
  });
  if (is_good && !triangles.empty()) return triangles;
  return in_building(triangulate(local.points, local.rings, axis));
}

double tilt_deg(Vec3 a, Vec3 b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

/// How far the normals deviate at most, and of which triangle.
struct WorstFold {
  double tilt_deg = 0;
  std::size_t triangle = 0;
};

WorstFold worst_fold(std::span<const Vec3> normals, double tolerance_deg, FoldsBetween folds) {
  const Vec3 largest = *std::ranges::max_element(normals, {}, length);
  std::vector<double> tilts_deg;
  for (const Vec3 normal : normals) tilts_deg.push_back(tilt_deg(largest, normal));
  const auto worst = std::ranges::max_element(tilts_deg);
  WorstFold fold{*worst, static_cast<std::size_t>(worst - tilts_deg.begin())};
  if (folds == FoldsBetween::largest_and_others) return fold;
  // Of two that deviate too much from each other one does so by half of it from any third.
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (tilts_deg[i] <= tolerance_deg / 2) continue;
    for (const Vec3 normal : normals)
      if (const double tilt = tilt_deg(normal, normals[i]); tilt > fold.tilt_deg) fold = {tilt, i};
  }
  return fold;
}

/// val3dity 204.
bool is_unfolded(const SnappedBuilding& building, const SnappedPolygon& polygon,
                 std::span<const CornersOfTriangle> triangles, double tolerance_deg,
                 FoldsBetween folds, FindingList& findings) {
  std::vector<Vec3> normals;
  for (const auto& [a, b, c] : triangles)
    normals.push_back(
        cross(building.metres(b) - building.metres(a), building.metres(c) - building.metres(a)));
  if (normals.empty()) return true;
  const WorstFold worst = worst_fold(normals, tolerance_deg, folds);
  if (worst.tilt_deg <= tolerance_deg) return true;
  findings.add(Defect::folded, subject_of(polygon),
               fmt::format("polygon {} is folded: the normals of its triangles deviate by {:.1f}°; "
                           "the tolerance is {}°",
                           polygon.number, worst.tilt_deg, tolerance_deg),
               {triangles[worst.triangle][0]});
  return false;
}

bool is_bare_triangle(const SnappedPolygon& polygon) {
  return polygon.rings.size() == 1 && polygon.rings[0].size() == 3;
}

JudgedPolygon judge_triangle(const SnappedBuilding& building, const SnappedPolygon& polygon,
                             FindingList& findings) {
  const std::vector<int>& ring = polygon.rings[0];
  if (are_collinear(building.point(ring[0]), building.point(ring[1]), building.point(ring[2]))) {
    Subject subject = subject_of(polygon);
    subject.ring = 0;
    findings.add(Defect::ring_crosses_itself, subject,
                 fmt::format("polygon {}, a triangle, has no area", polygon.number), {ring[0]});
    return {};
  }
  return {true, {{ring[0], ring[1], ring[2]}}};
}

}  // namespace

JudgedPolygon judge(const SnappedBuilding& building, const SnappedPolygon& polygon,
                    const ValidateOptions& options, FindingList& findings, FoldsBetween folds) {
  if (!have_good_points(polygon, findings)) return {};
  if (is_bare_triangle(polygon)) return judge_triangle(building, polygon, findings);
  std::vector<Vec3> points;
  for (const auto& ring : polygon.rings)
    for (const int vertex : ring) points.push_back(building.metres(vertex));
  const FittedPlane plane = fit_plane(points);
  if (!is_near_plane(building, polygon, plane, options.planarity_m, findings)) return {};
  const FlatPolygon flat = flat_polygon(building, polygon, plane.normal);
  const bool is_good = are_simple(polygon, flat, findings) &&
                       are_holes_turned_well(polygon, flat, findings) &&
                       lie_well(polygon, flat, findings);
  if (!is_good) return {};
  JudgedPolygon out{true, triangles_of(building, polygon, flat.axis)};
  out.is_good =
      is_unfolded(building, polygon, out.triangles, options.planarity_deg, folds, findings);
  return out;
}

}  // namespace oriel::detail
