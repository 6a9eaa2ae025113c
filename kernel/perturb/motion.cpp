#include "kernel/perturb/motion.h"

#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace oriel {

namespace {

/// Cosine and sine; of quarter turns exact.
std::pair<double, double> cos_and_sin(double angle_deg) {
  double rest_deg = std::fmod(angle_deg, 360);
  if (rest_deg < 0) rest_deg += 360;
  if (rest_deg == 0) return {1, 0};
  if (rest_deg == 90) return {0, 1};
  if (rest_deg == 180) return {-1, 0};
  if (rest_deg == 270) return {0, -1};
  const double rest_rad = rest_deg * std::numbers::pi / 180;
  return {std::cos(rest_rad), std::sin(rest_rad)};
}

}  // namespace

Motion::Motion(Vec3 centre, double rotation_deg, Vec3 shift_m)
    : centre_(centre), shift_m_(shift_m) {
  std::tie(cos_, sin_) = cos_and_sin(rotation_deg);
  is_still_ = cos_ == 1 && sin_ == 0 && shift_m == Vec3{};
}

Vec3 Motion::after(Vec3 point) const {
  if (is_still_) return point;
  const Vec3 d = point - centre_;
  return centre_ + Vec3{cos_ * d.x - sin_ * d.y, sin_ * d.x + cos_ * d.y, d.z} + shift_m_;
}

Vec3 Motion::before(Vec3 point) const {
  if (is_still_) return point;
  const Vec3 d = point - shift_m_ - centre_;
  return centre_ + Vec3{cos_ * d.x + sin_ * d.y, cos_ * d.y - sin_ * d.x, d.z};
}

Box box_before(const Motion& motion, std::span<const Vec3> points) {
  Box box;
  for (const Vec3 p : points) box.grow(motion.before(p));
  return box;
}

}  // namespace oriel
