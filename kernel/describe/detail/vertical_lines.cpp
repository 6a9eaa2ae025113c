#include "kernel/describe/detail/vertical_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ranges>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// A face that covers the whole building stands in all cells: more of them cost more than they
/// spare.
constexpr int kLargestSide = 64;
/// Far more than computed heights are off by rounding, far less than surfaces are apart.
constexpr double kRounding_m = 1e-9;

/// From below, of equal heights by number.
std::pair<double, int> order(const LineCrossing& c) { return {c.z, c.face}; }

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
  side_ = std::clamp(static_cast<int>(2 * std::sqrt(static_cast<double>(lying.size()))), 1,
                     kLargestSide);
  cells_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
  for (const int f : lying) {
    const Box& box = faces[static_cast<std::size_t>(f)].box;
    const Entry entry = entry_of(faces[static_cast<std::size_t>(f)], f);
    for (int row = row_of(box.min.y); row <= row_of(box.max.y); ++row)
      for (int column = column_of(box.min.x); column <= column_of(box.max.x); ++column)
        cells_[static_cast<std::size_t>(row * side_ + column)].push_back(entry);
  }
  for (auto& cell : cells_)
    std::ranges::sort(cell, {}, [](const Entry& e) { return std::tuple(e.z0, e.face); });
}

/// A plane's heights over a box are between those over its corners.
VerticalLines::Entry VerticalLines::entry_of(const SurfaceFace& face, int number) {
  const Box& box = face.box;
  Entry entry{box.min.x, box.max.x, box.min.y, box.max.y, Box::kInfinity, -Box::kInfinity, number};
  for (const double x : {box.min.x, box.max.x})
    for (const double y : {box.min.y, box.max.y}) {
      const double z = face.z_at({x, y, 0});
      entry.z0 = std::min(entry.z0, z - kRounding_m);
      entry.z1 = std::max(entry.z1, z + kRounding_m);
    }
  return entry;
}

int VerticalLines::column_of(double x) const { return cell(x, box_.min.x, box_.max.x, side_); }
int VerticalLines::row_of(double y) const { return cell(y, box_.min.y, box_.max.y, side_); }

const std::vector<VerticalLines::Entry>& VerticalLines::cell_of(Vec3 point) const {
  return cells_[static_cast<std::size_t>(row_of(point.y) * side_ + column_of(point.x))];
}

std::optional<LineCrossing> VerticalLines::crossing(const Entry& e, Vec3 point) const {
  if (point.x < e.x0 || point.x > e.x1 || point.y < e.y0 || point.y > e.y1) return std::nullopt;
  const auto face = static_cast<std::size_t>(e.face);
  if (!figures_[face].contains(point)) return std::nullopt;
  return LineCrossing{faces_[face].z_at(point), e.face};
}

std::vector<LineCrossing> VerticalLines::at(Vec3 point) const {
  std::vector<LineCrossing> crossings;
  for (const Entry& e : cell_of(point))
    if (const auto c = crossing(e, point)) crossings.push_back(*c);
  std::ranges::sort(crossings, {}, order);
  return crossings;
}

std::optional<LineCrossing> VerticalLines::next_above(Vec3 point, double z) const {
  std::optional<LineCrossing> best;
  for (const Entry& e : cell_of(point)) {
    if (best && e.z0 > best->z) break;
    if (e.z1 <= z) continue;
    const auto c = crossing(e, point);
    if (c && c->z > z && (!best || order(*c) < order(*best))) best = c;
  }
  return best;
}

std::optional<LineCrossing> VerticalLines::next_below(Vec3 point, double z) const {
  std::optional<LineCrossing> best;
  for (const Entry& e : std::views::reverse(cell_of(point))) {
    if (e.z0 > z || (best && e.z1 < best->z)) continue;
    const auto c = crossing(e, point);
    if (c && c->z <= z && (!best || order(*best) < order(*c))) best = c;
  }
  return best;
}

}  // namespace oriel::detail
