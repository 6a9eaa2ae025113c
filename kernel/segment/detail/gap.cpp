#include "kernel/segment/detail/gap.h"

#include "kernel/model/detail/index.h"
#include "kernel/segment/detail/sweep.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace oriel::detail {

namespace {

class FarEnd {
 public:
  FarEnd(const Boundary& body, const Section& section, int plane)
      : body_(body),
        section_(section),
        axis_(body.world().planes.normal(section.looking())),
        offset_m_(body.world().planes.offset_m(2 * plane + (section.looking() & 1))),
        ranks_(body.world().points.ranks(body.world().planes.class_of(plane))),
        limit_(body.world().planes.rank_of(plane) * section.direction),
        areas_(body.on_plane(plane).areas) {
    // From there one looks back: the split side of air is the one that `section` looks to.
    if ((section.looking() & 1) != 0) std::swap(areas_[0], areas_[1]);
  }

  double margin() {
    double least = std::numeric_limits<double>::infinity();
    for (const Region& region : section_.regions) {
      const double old = areas_[region.is_material ? 1 : 0];
      if (old <= 0) continue;
      const auto area = area_of(region);
      if (!area) return 0;
      const double covered = areas_[region.is_material ? 0 : 1];
      least = std::min(least, *area - kSweptArea_m2 - covered - old);
    }
    return least;
  }

 private:
  /// Nothing if a vertex lies in the gap, or if the outline may follow edges at its end.
  std::optional<double> area_of(const Region& region) const {
    double sum = 0;
    for (const int l : region.loops) {
      bool is_crossed = false;
      const auto area = area_of(l, is_crossed);
      if (!area || (l == region.loops[0] && !is_crossed)) return std::nullopt;
      sum += *area;
    }
    return region.is_material ? sum : -sum;
  }

  /// `is_crossed`: an edge goes on beyond the plane, so a chord there follows no edge.
  std::optional<double> area_of(int loop, bool& is_crossed) const {
    const int first = section_.loops[at(loop)].first;
    Vec3 origin, sum, from;
    int c = first;
    do {
      const Crossing& crossing = section_.crossings[at(c)];
      const int rank = ranks_[at(body_.origin(crossing.edge))] * section_.direction;
      if (rank < limit_) return std::nullopt;
      is_crossed |= rank > limit_;
      const Vec3 here = end_of(crossing, rank == limit_);
      if (c == first) origin = here;
      const Vec3 to = here - origin;
      sum = sum + cross(from, to);
      from = to;
      c = crossing.next;
    } while (c != first);
    return dot(sum, axis_) / 2;
  }

  /// Where the edge of a crossing leaves the gap.
  [[nodiscard]] Vec3 end_of(const Crossing& crossing, bool ends_on_plane) const {
    const Vec3 up = body_.at(crossing.edge);
    if (ends_on_plane) return up;
    const double rise = dot(axis_, up - crossing.at), above = dot(axis_, up) - offset_m_;
    return rise > 0 ? up + (above / rise) * (crossing.at - up) : up;
  }

  const Boundary& body_;
  const Section& section_;
  Vec3 axis_;
  double offset_m_;
  std::span<const int> ranks_;
  int limit_;
  /// The body's facets on the split side of air and of material.
  std::array<double, 2> areas_;
};

}  // namespace

double margin_across_gap(const Boundary& body, const Section& section, int plane) {
  return FarEnd(body, section, plane).margin();
}

}  // namespace oriel::detail
