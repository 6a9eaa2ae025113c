#include "kernel/describe/detail/vertical_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace oriel::detail {

namespace {

/// A face that covers the whole building stands in all cells: more of them cost more than they
/// spare.
constexpr int kLargestSide = 64;
/// Ground, roof, and the sills and lintels of a few storeys.
constexpr std::size_t kUsualCrossings = 16;

int cell(double value, double low, double high, int count) {
  if (!(high > low)) return 0;
  const double scaled = (value - low) / (high - low) * count;
  return static_cast<int>(std::clamp(scaled, 0.0, static_cast<double>(count - 1)));
}

}  // namespace

VerticalLines::VerticalLines(std::span<const SurfaceFace> faces) : faces_(faces) {
  figures_.reserve(faces.size());
  std::vector<int> lying;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const bool is_lying = !faces[f].is_steep();
    figures_.emplace_back(is_lying ? std::span<const Outline>(faces[f].outlines)
                                   : std::span<const Outline>());
    if (!is_lying) continue;
    lying.push_back(static_cast<int>(f));
    box_.grow(faces[f].box);
  }
  side_ =
      std::clamp(static_cast<int>(std::sqrt(static_cast<double>(lying.size()))), 1, kLargestSide);
  cells_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
  for (const int f : lying) {
    const Box& box = faces[static_cast<std::size_t>(f)].box;
    for (int row = row_of(box.min.y); row <= row_of(box.max.y); ++row)
      for (int column = column_of(box.min.x); column <= column_of(box.max.x); ++column)
        cells_[static_cast<std::size_t>(row * side_ + column)].push_back(
            {box.min.x, box.max.x, box.min.y, box.max.y, f});
  }
}

int VerticalLines::column_of(double x) const { return cell(x, box_.min.x, box_.max.x, side_); }
int VerticalLines::row_of(double y) const { return cell(y, box_.min.y, box_.max.y, side_); }

std::vector<LineCrossing> VerticalLines::at(Vec3 point) const {
  std::vector<LineCrossing> crossings;
  crossings.reserve(kUsualCrossings);
  if (box_.is_empty()) return crossings;
  const auto place = static_cast<std::size_t>(row_of(point.y) * side_ + column_of(point.x));
  for (const Entry& e : cells_[place]) {
    if (point.x < e.x0 || point.x > e.x1 || point.y < e.y0 || point.y > e.y1) continue;
    if (figures_[static_cast<std::size_t>(e.face)].contains(point))
      crossings.push_back({faces_[static_cast<std::size_t>(e.face)].z_at(point), e.face});
  }
  std::ranges::sort(crossings, {}, [](const LineCrossing& c) { return std::tuple(c.z, c.face); });
  return crossings;
}

}  // namespace oriel::detail
