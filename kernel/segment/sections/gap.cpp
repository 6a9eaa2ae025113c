#include "kernel/segment/sections/gap.h"

#include "kernel/base/index.h"
#include "kernel/segment/sections/nested_loops.h"
#include "kernel/segment/sections/sweep.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
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

  double margin() const {
    if (!is_sound() || !do_all_reach()) return 0;
    double least = std::numeric_limits<double>::infinity();
    for (const Region& region : section_.regions) {
      const double old = areas_[region.is_material ? 1 : 0];
      if (old <= 0) continue;
      if (!is_crossed(region.loops[0])) return 0;
      const double covered = areas_[region.is_material ? 0 : 1];
      least = std::min(least, area_of(region) - kSweptArea_m2 - covered - old);
    }
    return least;
  }

 private:
  /// Each loop belongs to a region of material, be it as a hole. One that pokes out of its facet
  /// (bad input) does not, and may do so at the other end.
  [[nodiscard]] bool is_sound() const {
    std::size_t loops = 0;
    for (const Region& region : section_.regions)
      if (region.is_material) loops += region.loops.size();
    return loops == section_.loops.size();
  }

  [[nodiscard]] int level_of_end(const Crossing& c) const {
    return ranks_[at(body_.origin(c.edge))] * section_.direction - limit_;
  }

  /// No edge ends in the gap.
  [[nodiscard]] bool do_all_reach() const {
    return std::ranges::all_of(section_.crossings,
                               [&](const Crossing& c) { return level_of_end(c) >= 0; });
  }

  /// An edge goes on beyond the plane, so a chord there follows no edge.
  [[nodiscard]] bool is_crossed(int loop) const {
    bool is_beyond = false;
    for_each_crossing(section_, loop, [&](const Crossing& c) { is_beyond |= level_of_end(c) > 0; });
    return is_beyond;
  }

  [[nodiscard]] double area_of(const Region& region) const {
    double sum = 0;
    for (const int l : region.loops) sum += area_of(l);
    return region.is_material ? sum : -sum;
  }

  [[nodiscard]] double area_of(int loop) const {
    const Vec3 origin = end_of(section_.crossings[at(section_.loops[at(loop)].first)]);
    Vec3 sum, from;
    for_each_crossing(section_, loop, [&](const Crossing& c) {
      const Vec3 to = end_of(c) - origin;
      sum = sum + cross(from, to);
      from = to;
    });
    return dot(sum, axis_) / 2;
  }

  /// Where the edge of a crossing leaves the gap.
  [[nodiscard]] Vec3 end_of(const Crossing& crossing) const {
    const Vec3 up = body_.at(crossing.edge);
    if (level_of_end(crossing) == 0) return up;
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
