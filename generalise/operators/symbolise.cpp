#include "generalise/operators/symbolise.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oriel {

namespace {

using detail::Extents;
using detail::Host;
using detail::Placed;

constexpr Vec3 kUp{0, 0, 1};
/// Roofs flatter than this (sine, 3 degrees) have no fall.
constexpr double kFlat = 0.05;

/// An upright box around some of the feature, in the plan of its roof: u along the eaves, `fall`
/// down the slope.
class OnRoof {
 public:
  OnRoof(const Redrawing& task, const Host& host) : task_(task), host_(host) {
    fall_ = normalised(cross(host.u, kUp));
    if (dot(fall_, host.n) < 0) fall_ = -fall_;
    for (const int v : task.feature().vertices) {
      const Vec3 p = task.segmentation.vertices[static_cast<std::size_t>(v)].point;
      u_.push_back(dot(p, host.u));
      f_.push_back(dot(p, fall_));
      top_m_ = std::max(top_m_, p.z);
    }
  }

  Placed chimney() const {
    const double to_m = task_.to_m();
    const auto [u0, u1] = widened(u_, to_m);
    const auto [f0, f1] = widened(f_, to_m);
    return placed(
        {side(-host_.u, u0), side(host_.u, u1), side(-fall_, f0), side(fall_, f1), top()});
  }

  Placed dormer() const {
    if (std::hypot(host_.n.x, host_.n.y) < kFlat)
      return {std::nullopt, "a dormer box needs a sloping roof"};
    const double to_m = task_.to_m();
    const auto [u0, u1] = widened(u_, to_m);
    const double front = *std::ranges::max_element(f_);
    return placed({side(-host_.u, u0), side(host_.u, u1), side(fall_, front), top()});
  }

 private:
  static std::pair<double, double> widened(const std::vector<double>& along, double least) {
    const auto [low, high] = std::ranges::minmax(along);
    const double middle = (low + high) / 2, half = std::max(high - low, least) / 2;
    return {middle - half, middle + half};
  }
  [[nodiscard]] Plane side(Vec3 direction, double along) const {
    // `along` counts along u or the fall, whichever way the side looks.
    const double sign = dot(direction, host_.u) + dot(direction, fall_) > 0 ? 1 : -1;
    return plane_through(task_.solid, direction, sign * along * direction,
                         detail::kSameDirection_deg);
  }
  [[nodiscard]] Plane top() const {
    return plane_through(task_.solid, kUp, {0, 0, top_m_}, detail::kSameDirection_deg);
  }
  [[nodiscard]] Placed placed(const std::vector<Plane>& planes) const {
    return detail::place(task_.solid, {host_.facet}, planes, Attach::raise, task_.gap_m(),
                         task_.feature().source_polygons);
  }

  const Redrawing& task_;
  const Host& host_;
  Vec3 fall_;
  std::vector<double> u_, f_;
  double top_m_ = -Box::kInfinity;
};

/// A slab: its thickness is what the feature's volume makes of its width and depth.
Placed balcony(const Redrawing& task, const Host& host) {
  const Feature& feature = task.feature();
  Extents where = extents_of(host, task.segmentation, feature);
  const double to_m = task.to_m();
  const double more = std::max(0.0, to_m - where.width());
  where.u0 -= more / 2;
  where.u1 += more / 2;
  const double depth_m = std::max(where.out1, to_m / 2);
  where.v1 = where.v0 + std::min(where.height(), feature.volume_m3 / (where.width() * depth_m));
  return place_box(task.solid, host, where, depth_m, Attach::raise, task.gap_m(),
                   feature.source_polygons);
}

}  // namespace

Placed symbolise(const Redrawing& task) {
  const auto host = task.host();
  if (!host) return {std::nullopt, "its roof or wall is not found any more"};
  if (task.feature().sense != Sense::protrusion)
    return {std::nullopt, "only what sticks out can be symbolised"};
  const std::string with = task.word("with", "chimney_block");
  const bool is_roof = host->n.z > 0.26;
  if (with == "balcony_box")
    return is_roof ? Placed{std::nullopt, "a balcony box needs a wall"} : balcony(task, *host);
  if (!is_roof) return {std::nullopt, "a " + with + " needs a roof"};
  const OnRoof template_box(task, *host);
  return with == "dormer_box" ? template_box.dormer() : template_box.chimney();
}

}  // namespace oriel
