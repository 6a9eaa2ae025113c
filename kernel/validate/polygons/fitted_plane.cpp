#include "kernel/validate/polygons/fitted_plane.h"

#include "kernel/base/index.h"
#include "kernel/mesh/triangulate.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace oriel::detail {

namespace {

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

/// A direction in the plane across `normal`, of length 1.
Vec3 direction_across(Vec3 normal) {
  const bool is_steep = std::abs(normal.z) < std::abs(normal.x);
  return normalised(is_steep ? Vec3{-normal.y, normal.x, 0} : Vec3{0, -normal.z, normal.y});
}

/// Twice the area that a ring covers in the plane of x and y.
double turned_area(std::span<const Vec3> points, std::span<const int> ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 a = points[at(ring[i])], b = points[at(ring[(i + 1) % ring.size()])];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

}  // namespace

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

std::vector<std::array<int, 3>> triangulate_in_plane(const std::vector<Vec3>& points,
                                                     const std::vector<std::vector<int>>& rings) {
  std::vector<Vec3> outer;
  for (const int v : rings[0]) outer.push_back(points[at(v)]);
  const FittedPlane plane = fit_plane(outer);
  const Vec3 u = direction_across(plane.normal), v = cross(plane.normal, u);
  std::vector<Vec3> turned;
  for (const Vec3 p : points)
    turned.push_back({dot(u, p - plane.centre), dot(v, p - plane.centre), 0});
  const double up = turned_area(turned, rings[0]) < 0 ? -1 : 1;
  return triangulate(turned, rings, {0, 0, up});
}

}  // namespace oriel::detail
