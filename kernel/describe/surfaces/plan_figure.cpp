#include "kernel/describe/surfaces/plan_figure.h"

#include <algorithm>
#include <numeric>

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

}  // namespace oriel::detail
