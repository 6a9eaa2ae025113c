#include "kernel/segment/cuts/cap_areas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace oriel::detail {

namespace {

/// Normals whose parallelepiped has less volume (or area) tell nothing of each other's caps.
constexpr double kFlat = 1e-3;  // of unit vectors, no tolerance of the model

/// A linear programme: the least is that of up to three caps that alone close the surface.
class LeastCaps {
 public:
  LeastCaps(Vec3 open, double slack) : open_(open), slack_(slack) {
    if (length(open) <= slack) least_ = 0;
  }

  void offer(Vec3 n) {
    const double area = dot(open_, n);
    if (length(open_ - area * n) <= slack_) take(area, 0, 0, 1);
  }

  void offer(Vec3 n, Vec3 m) {
    const double c = dot(n, m), det = 1 - c * c;
    if (det < kFlat) return;
    const double p = dot(open_, n), q = dot(open_, m);
    const double first = (p - c * q) / det, second = (q - c * p) / det;
    if (length(open_ - first * n - second * m) <= slack_) take(first, second, 0, det);
  }

  void offer(Vec3 n, Vec3 m, Vec3 k) {
    const Vec3 across = cross(m, k);
    const double det = dot(n, across);
    if (std::abs(det) < kFlat) return;
    take(dot(open_, across) / det, dot(open_, cross(k, n)) / det, dot(open_, cross(n, m)) / det,
         std::abs(det));
  }

  [[nodiscard]] double least() const { return least_; }

 private:
  void take(double first, double second, double third, double det) {
    if (std::min({first, second, third}) < -slack_ / det) return;
    least_ = std::min(least_, std::max(first, 0.0) + std::max(second, 0.0) + std::max(third, 0.0));
  }

  Vec3 open_;
  double slack_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

double least_cap_area(std::span<const Vec3> normals, Vec3 open, double slack_m2) {
  LeastCaps caps(open, slack_m2);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    caps.offer(normals[i]);
    for (std::size_t j = 0; j < i; ++j) {
      caps.offer(normals[i], normals[j]);
      for (std::size_t k = 0; k < j; ++k) caps.offer(normals[i], normals[j], normals[k]);
    }
  }
  return caps.least();
}

}  // namespace oriel::detail
