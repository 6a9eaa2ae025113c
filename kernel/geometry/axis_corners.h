#pragma once

#include "model/solid.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace oriel {

/// Where planes across the three axes meet. Most vertices of a building are such corners, and where
/// they are is no question: exact::meet and exact::to_metres say the same, at many times the cost.
class AxisCorners {
 public:
  /// `grid_m` is that of the planes.
  explicit AxisCorners(double grid_m) : grid_m_(grid_m) {}

  void reserve(std::size_t planes) { across_.reserve(planes); }
  /// The next plane, whatever its direction; planes count from 0.
  void add(const Plane& plane) { across_.push_back(across(plane)); }

  /// The meeting of three planes in metres; nothing if they are not across the three axes.
  [[nodiscard]] std::optional<Vec3> meeting(int p, int q, int r) const {
    std::array<double, 4> corner{};
    unsigned axes = 0;
    for (const int plane : {p, q, r}) {
      const AcrossAxis& here = across_[static_cast<std::size_t>(plane)];
      corner[here.axis] = here.level_m;
      axes |= 1U << here.axis;
    }
    constexpr unsigned kAllThree = 7;
    if (axes != kAllThree) return std::nullopt;
    return Vec3{corner[0], corner[1], corner[2]};
  }

 private:
  /// Which axis a plane stands across, and where; axis 3: none.
  struct AcrossAxis {
    std::size_t axis = 3;
    double level_m = 0;
  };
  [[nodiscard]] AcrossAxis across(const Plane& plane) const {
    const auto& [x, y, z] = plane.coefficients;
    const std::int64_t sign = x + y + z;
    if ((x != 0) + (y != 0) + (z != 0) != 1 || (sign != 1 && sign != -1)) return {};
    return {x != 0 ? 0U : y != 0 ? 1U : 2U, static_cast<double>(sign * plane.offset) * grid_m_};
  }

  double grid_m_;
  std::vector<AcrossAxis> across_;  ///< by plane
};

}  // namespace oriel
