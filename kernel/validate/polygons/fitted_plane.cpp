#include "kernel/validate/polygons/fitted_plane.h"

#include <array>
#include <cmath>
#include <cstddef>

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

}  // namespace oriel::detail
