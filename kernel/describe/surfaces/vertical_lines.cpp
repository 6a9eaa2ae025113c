#include "kernel/describe/surfaces/vertical_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <ranges>
#include <utility>

namespace oriel::detail {

namespace {

/// So many edges in a strip are quickly looked at.
constexpr std::size_t kEdgesPerStrip = 8;

}  // namespace

PlanFigure::PlanFigure(std::span<const OutlineView> outlines) {
  std::size_t edges = 0;
  for (const OutlineView outline : outlines) {
    edges += outline.size();
    for (const Vec3& p : outline) box_.grow(p);
  }
  first_.resize(2 + edges / kEdgesPerStrip, 0);
  for_each_touch(outlines, [&](std::size_t strip, const PlanEdge&) { ++first_[strip + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  edges_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for_each_touch(outlines, [&](std::size_t strip, const PlanEdge& edge) {
    edges_[static_cast<std::size_t>(next[strip]++)] = edge;
  });
}

/// Level edges touch no strip: no line along x crosses them.
template <class Visit>
void PlanFigure::for_each_touch(std::span<const OutlineView> outlines, Visit visit) const {
  for (const OutlineView outline : outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3 &from = outline[i], &to = outline[i + 1 < outline.size() ? i + 1 : 0];
      if (from.y == to.y) continue;
      const auto [low, high] = std::minmax(from.y, to.y);
      const std::size_t last = strip_of(high);
      for (std::size_t s = strip_of(low); s <= last; ++s) visit(s, {from.x, from.y, to.x, to.y});
    }
  }
}

std::size_t PlanFigure::strip_of(double y) const {
  const std::size_t strips = first_.size() - 1;
  const double size = box_.max.y - box_.min.y;
  if (strips == 1 || !(size > 0)) return 0;
  const auto count = static_cast<double>(strips);
  return static_cast<std::size_t>(std::clamp((y - box_.min.y) / size * count, 0.0, count - 1));
}

bool PlanFigure::contains(Vec3 point) const {
  if (point.x < box_.min.x || point.x > box_.max.x || point.y < box_.min.y || point.y > box_.max.y)
    return false;
  bool is_inside = false;
  const std::size_t strip = strip_of(point.y);
  const auto begin = edges_.begin() + first_[strip], end = edges_.begin() + first_[strip + 1];
  for (auto edge = begin; edge != end; ++edge) {
    if ((edge->from_y > point.y) == (edge->to_y > point.y)) continue;
    const double t = (point.y - edge->from_y) / (edge->to_y - edge->from_y);
    if (point.x < edge->from_x + t * (edge->to_x - edge->from_x)) is_inside = !is_inside;
  }
  return is_inside;
}

namespace {

/// A face that covers the whole building stands in all cells: more of them cost more than they
/// spare.
constexpr int kLargestSide = 64;
/// Far more than computed heights are off by rounding, far less than surfaces are apart.
constexpr double kRounding_m = 1e-9;  // tolerance of doubles

/// From below, of equal heights by number.
std::pair<double, int> order(const LineCrossing& c) { return {c.z, c.face}; }

int cell(double value, double low, double high, int count) {
  if (!(high > low)) return 0;
  const double scaled = (value - low) / (high - low) * count;
  return static_cast<int>(std::clamp(scaled, 0.0, static_cast<double>(count - 1)));
}

}  // namespace

VerticalLines::VerticalLines(const SurfaceFaces& faces) : faces_(faces) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces.is_upright(f) || faces[f].is_steep()) continue;
    entries_.push_back(entry_of(faces[f], static_cast<int>(f)));
    box_.grow(faces[f].box);
  }
  std::ranges::sort(entries_, {}, [](const FaceBox& e) { return std::pair(e.z0, e.face); });
  side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(entries_.size()))), 1,
                     kLargestSide);
  met_.resize(entries_.size());
  fill_cells();
}

/// A plane's heights over a box are between those over its corners. The mean of the corners is on
/// the plane as the middle is, and is found sooner.
VerticalLines::FaceBox VerticalLines::entry_of(const SurfaceFace& face, int number) {
  const Box& box = face.box;
  const Vec3 mean = face.mean();
  FaceBox entry{box.min.x,      box.max.x,       box.min.y, box.max.y,
                Box::kInfinity, -Box::kInfinity, number};
  for (const double x : {box.min.x, box.max.x})
    for (const double y : {box.min.y, box.max.y}) {
      const double z = z_at(face, mean, {x, y, 0});
      entry.z0 = std::min(entry.z0, z - kRounding_m);
      entry.z1 = std::max(entry.z1, z + kRounding_m);
    }
  return entry;
}

/// First how many there are in a cell, then which.
void VerticalLines::fill_cells() {
  std::vector<Cells> touched;
  touched.reserve(entries_.size());
  for (const FaceBox& entry : entries_) touched.push_back(cells_of(entry));
  const auto for_each_cell = [&](const Cells& cells, auto visit) {
    for (int row = cells.row0; row <= cells.row1; ++row)
      for (int column = cells.column0; column <= cells.column1; ++column)
        visit(static_cast<std::size_t>(row * side_ + column));
  };
  first_.assign(static_cast<std::size_t>(side_ * side_) + 1, 0);
  for (const Cells& cells : touched)
    for_each_cell(cells, [&](std::size_t cell) { ++first_[cell + 1]; });
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  in_cells_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t e = 0; e < touched.size(); ++e)
    for_each_cell(touched[e], [&](std::size_t cell) {
      in_cells_[static_cast<std::size_t>(next[cell]++)] = static_cast<int>(e);
    });
}

int VerticalLines::column_of(double x) const { return cell(x, box_.min.x, box_.max.x, side_); }
int VerticalLines::row_of(double y) const { return cell(y, box_.min.y, box_.max.y, side_); }

VerticalLines::Cells VerticalLines::cells_of(const FaceBox& e) const {
  return {row_of(e.y0), row_of(e.y1), column_of(e.x0), column_of(e.x1)};
}

std::span<const int> VerticalLines::cell_of(Vec3 point) const {
  const auto cell = static_cast<std::size_t>(row_of(point.y) * side_ + column_of(point.x));
  const auto begin = static_cast<std::size_t>(first_[cell]);
  return {in_cells_.data() + begin, static_cast<std::size_t>(first_[cell + 1]) - begin};
}

std::optional<LineCrossing> VerticalLines::crossing(std::size_t entry, Vec3 point) const {
  const FaceBox& e = entries_[entry];
  if (point.x < e.x0 || point.x > e.x1 || point.y < e.y0 || point.y > e.y1) return std::nullopt;
  const SurfaceFace& face = faces_[static_cast<std::size_t>(e.face)];
  auto& met = met_[entry];
  if (!met) met = Met{PlanFigure(face.outlines), face.middle()};
  if (!met->figure.contains(point)) return std::nullopt;
  return LineCrossing{z_at(face, met->middle, point), e.face};
}

std::vector<LineCrossing> VerticalLines::at(Vec3 point) const {
  std::vector<LineCrossing> crossings;
  for (const int e : cell_of(point))
    if (const auto c = crossing(static_cast<std::size_t>(e), point)) crossings.push_back(*c);
  std::ranges::sort(crossings, {}, order);
  return crossings;
}

std::optional<LineCrossing> VerticalLines::next_above(Vec3 point, double z) const {
  std::optional<LineCrossing> best;
  for (const int number : cell_of(point)) {
    const FaceBox& e = entries_[static_cast<std::size_t>(number)];
    if (best && e.z0 > best->z) break;
    if (e.z1 <= z) continue;
    const auto c = crossing(static_cast<std::size_t>(number), point);
    if (c && c->z > z && (!best || order(*c) < order(*best))) best = c;
  }
  return best;
}

std::optional<LineCrossing> VerticalLines::next_below(Vec3 point, double z) const {
  std::optional<LineCrossing> best;
  for (const int number : std::views::reverse(cell_of(point))) {
    const FaceBox& e = entries_[static_cast<std::size_t>(number)];
    if (e.z0 > z || (best && e.z1 < best->z)) continue;
    const auto c = crossing(static_cast<std::size_t>(number), point);
    if (c && c->z <= z && (!best || order(*best) < order(*c))) best = c;
  }
  return best;
}

}  // namespace oriel::detail
