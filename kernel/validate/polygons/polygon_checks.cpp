#include "kernel/validate/polygons/polygon_checks.h"

#include "kernel/mesh/triangulate.h"
#include "kernel/model/vec3.h"
#include "kernel/validate/polygons/ring_checks.h"

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

/// The plane for which the sum of squared distances of the points is least.
struct FittedPlane {
  Vec3 centre;
  /// Of length 1; across the line if all points are on one.
  Vec3 normal;

  [[nodiscard]] double distance(Vec3 point) const { return dot(normal, point - centre); }
};

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix covariance(std::span<const Vec3> points, Vec3 centre) {
  Matrix sum{};
  for (const Vec3 point : points) {
    const Vec3 d = point - centre;
    const std::array v{d.x, d.y, d.z};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) sum[i][j] += v[i] * v[j];
  }
  return sum;
}

/// One rotation of Jacobi's method: makes m[p][q] zero.
void rotate(Matrix& m, Matrix& vectors, std::size_t p, std::size_t q) {
  if (m[p][q] == 0) return;
  const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const double t = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0);
  const double s = t * c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double kp = m[k][p];
    const double kq = m[k][q];
    m[k][p] = c * kp - s * kq;
    m[k][q] = s * kp + c * kq;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double pk = m[p][k];
    const double qk = m[q][k];
    m[p][k] = c * pk - s * qk;
    m[q][k] = s * pk + c * qk;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double kp = vectors[k][p];
    const double kq = vectors[k][q];
    vectors[k][p] = c * kp - s * kq;
    vectors[k][q] = s * kp + c * kq;
  }
}

/// `points` must not be empty.
FittedPlane fit_plane(std::span<const Vec3> points) {
  Vec3 centre;
  for (const Vec3 point : points)
    centre = centre + (1.0 / static_cast<double>(points.size())) * point;
  Matrix m = covariance(points, centre);
  Matrix vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  // Jacobi's method converges quadratically: a 3 × 3 matrix is diagonal after five or six sweeps.
  for (int sweep = 0; sweep < 12; ++sweep)
    for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>{0, 1}, {0, 2}, {1, 2}})
      rotate(m, vectors, p, q);
  std::size_t least = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (m[i][i] < m[least][least]) least = i;
  return {centre, normalised({vectors[0][least], vectors[1][least], vectors[2][least]})};
}

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

/// The triangles of a polygon whose rings are good.
std::vector<std::array<int, 3>> triangles_of(const SnappedBuilding& building,
                                             const SnappedPolygon& polygon, Vec3 axis) {
  std::map<int, int> local_of;
  std::vector<int> vertices;
  std::vector<Vec3> points;
  std::vector<std::vector<int>> rings = polygon.rings;
  for (auto& ring : rings)
    for (int& vertex : ring) {
      const auto [found, is_new] = local_of.try_emplace(vertex, static_cast<int>(vertices.size()));
      if (is_new) {
        const MicrometrePoint& p = building.point(vertex);
        vertices.push_back(vertex);
        points.push_back(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
      }
      vertex = found->second;
    }
  auto triangles = triangulate(points, rings, axis);
  for (auto& triangle : triangles)
    for (int& corner : triangle) corner = vertices[static_cast<std::size_t>(corner)];
  return triangles;
}

/// val3dity 204: the normals of the triangles, against that of the largest one.
bool is_unfolded(const SnappedBuilding& building, const SnappedPolygon& polygon,
                 std::span<const std::array<int, 3>> triangles, double tolerance_deg,
                 FindingList& findings) {
  std::vector<Vec3> normals;
  for (const auto& [a, b, c] : triangles)
    normals.push_back(
        cross(building.metres(b) - building.metres(a), building.metres(c) - building.metres(a)));
  if (normals.empty()) return true;
  const Vec3 main = *std::ranges::max_element(normals, {}, length);
  double worst = -1;
  std::size_t where = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double angle = std::atan2(length(cross(main, normals[i])), dot(main, normals[i]));
    if (angle <= worst) continue;
    worst = angle;
    where = i;
  }
  const double worst_deg = worst * 180 / std::numbers::pi;
  if (worst_deg <= tolerance_deg) return true;
  findings.add(Defect::folded, subject_of(polygon),
               fmt::format("polygon {} is folded: the normals of its triangles deviate by {:.1f}°; "
                           "the tolerance is {}°",
                           polygon.number, worst_deg, tolerance_deg),
               {triangles[where][0]});
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
                    const ValidateOptions& options, FindingList& findings) {
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
  out.is_good = is_unfolded(building, polygon, out.triangles, options.planarity_deg, findings);
  return out;
}

}  // namespace oriel::detail
