#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace oriel::detail {

/// For each plane the points that are known to lie on it, ascending.
class Incidence {
 public:
  /// Makes the lists of all points from 0 on; `planes_of(point)` lists the planes of one.
  template <class PlanesOf>
  void make(int points, int planes, const PlanesOf& planes_of) {
    first_.assign(static_cast<std::size_t>(planes) + 2, 0);
    for (int p = 0; p < points; ++p)
      for (const int plane : planes_of(p)) ++first_[static_cast<std::size_t>(plane) + 2];
    for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
    points_.resize(first_.back());
    for (int p = 0; p < points; ++p)
      for (const int plane : planes_of(p))
        points_[first_[static_cast<std::size_t>(plane) + 1]++] = p;
  }

  [[nodiscard]] bool is_made() const { return !first_.empty(); }
  [[nodiscard]] std::span<const int> on(int plane) const {
    const std::size_t i = static_cast<std::size_t>(plane);
    return std::span(points_).subspan(first_[i], first_[i + 1] - first_[i]);
  }

 private:
  std::vector<std::size_t> first_;  ///< by plane, in points_
  std::vector<int> points_;
};

}  // namespace oriel::detail
