#pragma once

#include "kernel/validate/solids/predicates.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace oriel::detail {

/// The plane of a triangle in doubles, to tell which boxes lie beside it.
class TrianglePlane {
 public:
  explicit TrianglePlane(const MicrometreTriangle& triangle) {
    const auto vec = [](const MicrometrePoint& p) {
      return std::array{static_cast<double>(p[0]), static_cast<double>(p[1]),
                        static_cast<double>(p[2])};
    };
    point_ = vec(triangle[0]);
    const auto b = vec(triangle[1]), c = vec(triangle[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const double first = (b[j] - point_[j]) * (c[k] - point_[k]);
      const double second = (b[k] - point_[k]) * (c[j] - point_[j]);
      normal_[i] = first - second;
      size_[i] = std::abs(first) + std::abs(second);
    }
  }

  /// All of the box is on one side, and no corner on the plane: for certain, whatever rounding did.
  [[nodiscard]] bool is_beside(const Box& box) const {
    const std::array low{box.min.x, box.min.y, box.min.z}, high{box.max.x, box.max.y, box.max.z};
    double height = 0, reach = 0, error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double middle = 0.5 * (low[i] + high[i]) - point_[i], half = 0.5 * (high[i] - low[i]);
      height += normal_[i] * middle;
      reach += std::abs(normal_[i]) * half;
      error += size_[i] * (std::abs(middle) + half);
    }
    return std::abs(height) > reach + kError * error;
  }

  /// 1 before the plane, -1 behind it, for certain; 0: on it, or too near to tell.
  [[nodiscard]] int side_of(const MicrometrePoint& p) const {
    double height = 0, error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double off = static_cast<double>(p[i]) - point_[i];
      height += normal_[i] * off;
      error += size_[i] * std::abs(off);
    }
    return height > kError * error ? 1 : height < -kError * error ? -1 : 0;
  }

 private:
  static constexpr double kError = 1e-14;  // tolerance of doubles: some 50 ulp for 10 terms

  std::array<double, 3> point_{}, normal_{}, size_{};
};

}  // namespace oriel::detail
