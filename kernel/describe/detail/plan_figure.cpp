#include "kernel/describe/detail/plan_figure.h"

#include <algorithm>

namespace oriel::detail {

namespace {

/// So many edges in a strip are quickly looked at.
constexpr std::size_t kEdgesPerStrip = 8;

}  // namespace

PlanFigure::PlanFigure(std::span<const Outline> outlines) {
  std::size_t edges = 0;
  for (const Outline& outline : outlines) {
    edges += outline.size();
    for (const Vec3 p : outline) box_.grow(p);
  }
  strips_.resize(1 + edges / kEdgesPerStrip);
  for (const Outline& outline : outlines) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Edge edge{outline[i], outline[(i + 1) % outline.size()]};
      const auto [low, high] = std::minmax(edge.from.y, edge.to.y);
      if (low == high) continue;
      for (std::size_t s = strip_of(low); s <= strip_of(high); ++s) strips_[s].push_back(edge);
    }
  }
}

std::size_t PlanFigure::strip_of(double y) const {
  const double size = box_.max.y - box_.min.y;
  if (!(size > 0)) return 0;
  const auto count = static_cast<double>(strips_.size());
  return static_cast<std::size_t>(std::clamp((y - box_.min.y) / size * count, 0.0, count - 1));
}

bool PlanFigure::contains(Vec3 point) const {
  if (point.x < box_.min.x || point.x > box_.max.x || point.y < box_.min.y || point.y > box_.max.y)
    return false;
  bool is_inside = false;
  for (const Edge& edge : strips_[strip_of(point.y)]) {
    if ((edge.from.y > point.y) == (edge.to.y > point.y)) continue;
    const double t = (point.y - edge.from.y) / (edge.to.y - edge.from.y);
    if (point.x < edge.from.x + t * (edge.to.x - edge.from.x)) is_inside = !is_inside;
  }
  return is_inside;
}

}  // namespace oriel::detail
