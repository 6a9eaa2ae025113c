#include "generalise/operators/operators.h"
#include "kernel/attach/move_facet.h"
#include "kernel/geometry/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace oriel {

namespace {

using detail::Extents;
using detail::Host;
using detail::Placed;

constexpr Vec3 kUp{0, 0, 1};
/// Roofs flatter than this (sine, 3 degrees) have no fall.
constexpr double kFlat = 0.05;

/// The way in which an upright plane looks that is no more than 45 degrees off a direction, the
/// nearest one; the direction if there is none.
Vec3 upright_like(const Solid& solid, Vec3 direction) {
  constexpr double kUpright = 0.02;
  double best = std::numbers::sqrt2 / 2;
  Vec3 like = direction;
  for (const Plane& plane : solid.planes) {
    const double along = dot(plane.normal, direction);
    if (std::abs(plane.normal.z) > kUpright || std::abs(along) <= best) continue;
    best = std::abs(along);
    like = along > 0 ? plane.normal : -plane.normal;
  }
  return like;
}

/// The shortest edge of the facets that one solid has more than the other.
double shortest_new_edge(const Solid& before, const Solid& after) {
  double shortest = Box::kInfinity;
  for (std::size_t f = before.facets.size(); f < after.facets.size(); ++f)
    for (const Loop& loop : after.facets[f].loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const auto point = [&](std::size_t k) {
          return after.vertices[static_cast<std::size_t>(loop[k % loop.size()])].point;
        };
        shortest = std::min(shortest, length(point(i + 1) - point(i)));
      }
  return shortest;
}

/// An upright box around some of the feature, in the plan of its roof: u along the eaves, `fall`
/// down the slope, both as walls look, if there are such: so a block has no direction of its own.
class RoofTemplate {
 public:
  RoofTemplate(const Redrawing& task, const Host& host)
      : task_(task), host_(host), u_axis_(upright_like(task.solid, host.u)) {
    Vec3 fall = normalised(cross(host.u, kUp));
    if (dot(fall, host.n) < 0) fall = -fall;
    fall_ = upright_like(task.solid, fall);
    constexpr double kSkewed = 0.5;
    if (std::abs(dot(fall_, u_axis_)) > kSkewed) {
      u_axis_ = host.u;
      fall_ = fall;
    }
    for (const int v : task.feature().vertices) {
      const Vec3 p = task.segmentation.vertices[static_cast<std::size_t>(v)].point;
      u_.push_back(dot(p, u_axis_));
      f_.push_back(dot(p, fall_));
      top_m_ = std::max(top_m_, p.z);
    }
  }

  /// At its place, or where that is not possible next to it: over no more than half of its side.
  Placed chimney() const {
    const double to_m = task_.to_m();
    const auto u = widened(u_, to_m), f = widened(f_, to_m);
    Placed first;
    for (const auto& [along, down] : shifts()) {
      const double by_u = along * (u.second - u.first) / kShiftParts;
      const double by_f = down * (f.second - f.first) / kShiftParts;
      Placed placed = block({side(u_axis_, u.first + by_u, -1), side(fall_, f.second + by_f),
                             side(u_axis_, u.second + by_u), side(fall_, f.first + by_f, -1)},
                            top());
      if (placed.solid && shortest_new_edge(task_.solid, *placed.solid) >= least_edge_m())
        return placed;
      const bool is_better = placed.solid && !first.solid;
      if (is_better || (first.reason.empty() && !first.solid)) first = std::move(placed);
    }
    return first;
  }

  Placed dormer() const {
    if (std::hypot(host_.n.x, host_.n.y) < kFlat)
      return {std::nullopt, "a dormer box needs a sloping roof"};
    const double to_m = task_.to_m();
    const auto [u0, u1] = widened(u_, to_m);
    const double front = *std::ranges::max_element(f_);
    return block({side(u_axis_, u0, -1), side(fall_, front), side(u_axis_, u1), top()}, {});
  }

 private:
  static std::pair<double, double> widened(const std::vector<double>& along, double least) {
    const auto [low, high] = std::ranges::minmax(along);
    const double middle = (low + high) / 2, half = std::max(high - low, least) / 2;
    return {middle - half, middle + half};
  }
  /// A side at that place along u or the fall; with a sign of -1 it looks back.
  [[nodiscard]] Plane side(Vec3 axis, double along, double sign = 1) const {
    return plane_through(task_.solid, sign * axis, along * axis, detail::kSameDirection_deg);
  }
  [[nodiscard]] Plane top() const {
    return plane_through(task_.solid, kUp, {0, 0, top_m_}, detail::kSameDirection_deg);
  }
  /// Steps along the eaves and down the slope, the shortest ways first.
  static std::vector<std::pair<int, int>> shifts() {
    std::vector<std::pair<int, int>> all;
    for (int along = -kShiftParts / 2; along <= kShiftParts / 2; ++along)
      for (int down = -kShiftParts / 2; down <= kShiftParts / 2; ++down)
        all.emplace_back(along, down);
    std::ranges::stable_sort(all, {}, [](const std::pair<int, int>& shift) {
      return shift.first * shift.first + shift.second * shift.second;
    });
    return all;
  }

  /// What is shorter is not seen on the map.
  [[nodiscard]] double least_edge_m() const { return kGapOnMap_m * task_.scale; }

  /// On its facet, or across the edges of the roof; sides in turn, as raise_across() takes them.
  [[nodiscard]] Placed block(std::vector<Plane> sides, const std::optional<Plane>& lid) const {
    const Clearance clearance(task_.gap_m());
    const std::vector<int>& polygons = task_.feature().source_polygons;
    std::vector<Plane> planes = sides;
    if (lid) planes.push_back(*lid);
    Placed on_one =
        detail::place(task_.solid, {host_.facet}, planes, Attach::raise, clearance, polygons);
    if (on_one.solid) return on_one;
    // Counter-clockwise seen from above, whichever way the fall of a flat roof goes.
    if (cross(sides[1].normal, sides[0].normal).z > 0) std::swap(sides[0], sides[2]);
    return detail::place_across(task_.solid, {std::move(sides), lid, least_edge_m()}, clearance,
                                polygons);
  }

  static constexpr int kShiftParts = 8;

  const Redrawing& task_;
  const Host& host_;
  Vec3 u_axis_, fall_;
  std::vector<double> u_, f_;
  double top_m_ = -Box::kInfinity;
};

/// A slab: its thickness is what the feature's volume makes of its width and depth.
Placed balcony(const Redrawing& task, const Host& host) {
  const Feature& feature = task.feature();
  Extents where = extents_of(host, task.segmentation, feature);
  const Clearance clearance = clearance_after(host, task.gap_m(), {where});
  const double to_m = task.to_m();
  where = grown(where, std::max(0.0, to_m - where.width()), 0);
  const double depth_m = std::max(where.out1, to_m / 2);
  where.v1 = where.v0 + std::min(where.height(), feature.volume_m3 / (where.width() * depth_m));
  return place_box(task.solid, host, where, depth_m, Attach::raise, clearance,
                   feature.source_polygons);
}

/// Of more than this share of its facet a feature is what one sees of the facet.
constexpr double kMostOfFacet = 0.5;

/// An imprint on the facet that was not taken off: the facet still names its polygons.
bool carries_outline(const Redrawing& task, const Host& host) {
  const std::vector<int>& its = task.solid.facets[host.facet.index()].polygons;  // sorted
  return std::ranges::any_of(task.segmentation.features, [&](const Feature& feature) {
    return feature.sense == Sense::imprint && !feature.source_polygons.empty() &&
           std::ranges::includes(its, feature.source_polygons);
  });
}

}  // namespace

/// Makes a feature part of its host: its shape stays, but its facets are named by their slope, and
/// it is no object of its own any more. `task.solid` is the solid with the feature still on it.
///
/// Refused if no facet is made of the feature's polygons alone.
Placed merge(const Redrawing& task) {
  Solid solid = task.solid;
  const std::vector<int>& its = task.feature().source_polygons;  // sorted
  bool is_changed = false;
  for (Facet& facet : solid.facets) {
    if (facet.polygons.empty() || !std::ranges::includes(its, facet.polygons)) continue;
    facet.polygons.clear();
    is_changed = true;
  }
  if (!is_changed) return {std::nullopt, "it has no surface of its own"};
  return {std::move(solid), {}};
}

/// The operator `enlarge`: a feature becomes as large as can be seen (paper 5.1, "enlargement"): an
/// opening, or a slab that is too thin.
///
/// `{enlarge: {to: LENGTH, anchor: sill|centre, gap: LENGTH}}`: width and height become at least
/// `to`; the sill stays where it is, or the centre does. Where host margin or neighbours leave no
/// room for all of it, it grows as far as eighths of the way allow, else in one direction only.
/// Precondition: a recess in a wall, a block that is a box, or an outline (box_depth), on a facet
/// that is found again; some growth is possible. Touches: the wall's facet, and that of the ground
/// or slab that it stands on. Depth, directions and the parallel pane stay.
/// Inverse: omit, and the outline that the segmentation still has, sunk in or put on.
Placed enlarge(const Redrawing& task) {
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall is no longer found"};
  const Feature& feature = task.feature();
  const Extents now = extents_of(*host, task.segmentation, feature);
  const auto depth_m = box_depth(*host, feature, now);
  if (!depth_m || feature.sense == Sense::cavity)
    return {std::nullopt, "only recesses, blocks that are boxes and outlines can be enlarged"};
  const double to_m = task.to_m();
  const double more_u = std::max(0.0, to_m - now.width());
  const double more_v = std::max(0.0, to_m - now.height());
  if (more_u == 0 && more_v == 0) return {std::nullopt, "it is large enough", true};
  const bool is_on_sill = task.word("anchor", "centre") == "sill";
  const auto drawn = [&](double u, double v) {
    return place_like(task.solid, task.segmentation, *host, grown(now, u, v, is_on_sill), *depth_m,
                      feature.sense, clearance_after(*host, task.gap_m(), {now}), feature);
  };
  constexpr int kParts = 8;
  Placed placed;
  for (int part = kParts; part > 0; --part) {
    placed = drawn(more_u * part / kParts, more_v * part / kParts);
    if (placed.solid) return placed;
  }
  // Where it has room in one direction only it grows in that one.
  for (int part = kParts; part > 0 && more_u > 0 && more_v > 0; --part)
    for (const bool is_wider : {true, false}) {
      Placed one = is_wider ? drawn(more_u * part / kParts, 0) : drawn(0, more_v * part / kParts);
      if (one.solid) return one;
    }
  return placed;
}

/// The operator `symbolise`: a template takes the place of a feature, fitted to its size (paper
/// 5.1, "symbolisation").
///
/// `{symbolise: {with: TEMPLATE, to: LENGTH, gap: LENGTH}}`; sides are at least `to` long.
///  - chimney_block: an upright block on the roof with a flat top at the feature's top, its base
///    around the middle of the feature;
///  - dormer_box: a box with an upright front where the feature's was and a flat top at its top,
///    which runs back into the roof;
///  - balcony_box: a slab at the wall at the feature's bottom, as wide and as deep as it, with its
///    volume.
/// Precondition: a protrusion whose roof or wall is found again; there is room for the template on
/// that facet or, on a roof, across its edges. A chimney block that does not fit in its place moves
/// by no more than half of its sides. Touches: the facets under it. New directions: up; others only
/// if no wall looks within 45 degrees of where the eaves run or the roof falls: these. Inverse:
/// omit, and the feature's cells, which the segmentation still has.
Placed symbolise(const Redrawing& task) {
  const auto host = task.host();
  if (!host) return {std::nullopt, "its roof or wall is no longer found"};
  if (task.feature().sense != Sense::protrusion)
    return {std::nullopt, "only what sticks out can be symbolised"};
  const std::string with = task.word("with", "chimney_block");
  const bool is_roof = looks_up(host->n);
  if (with == "balcony_box")
    return is_roof ? Placed{std::nullopt, "a balcony box needs a wall"} : balcony(task, *host);
  if (!is_roof) return {std::nullopt, "a " + with + " needs a roof"};
  const RoofTemplate template_box(task, *host);
  return with == "dormer_box" ? template_box.dormer() : template_box.chimney();
}

/// The operator `collapse`: a recess, or what sticks out, loses its depth and leaves
/// its outline on its wall or roof as an imprint (paper 5.1; design, "collapse to imprint").
///
/// Precondition: its facet is found again and the outline, the rectangle around it in that facet,
/// lies inside. Touches: that facet, which is split along the outline. Inverse: omit, and the
/// feature's cells, which the segmentation still has.
Placed collapse(const Redrawing& task) {
  const auto host = task.host();
  if (!host) return {std::nullopt, "its wall or roof is no longer found"};
  const Feature& feature = task.feature();
  if (feature.sense == Sense::imprint) return {std::nullopt, "it has no depth"};
  return draw_outline(task.solid, *host, extents_of(*host, task.segmentation, feature), feature);
}

/// The operator `flatten`: what is thin and lies flat on its wall or roof goes into it (paper 5.1,
/// Figure 7: a lamina, and a cap that reaches beyond what it lies on).
///
/// What juts out beyond its facet is trimmed. If the rest covers more than half of the facet, the
/// facet takes its place: it moves outwards (of a recess inwards) by the feature's volume over its
/// own area, so that upright on its neighbours the volume is kept. The feature is gone in either
/// case. Precondition: it has depth; if its facet, which may have gone, is to move: it was split
/// off by one plane, no outline that stays is on the facet, and it can move (move_facet). Touches:
/// the facet and those around it. Inverse: the facet moves back, and the feature's cells, which the
/// segmentation still has.
Placed flatten(const Redrawing& task) {
  const Feature& feature = task.feature();
  if (feature.sense == Sense::imprint) return {std::nullopt, "it has no depth"};
  const auto host = task.host();
  Placed gone{task.solid, {}};
  gone.stays.emplace();
  if (!host) return gone;  // what it lay on went, too
  const double facet_m2 =
      area_m2(task.solid.vertices, task.solid.facets[host->facet.index()], host->n);
  const bool is_most = feature.planes.size() == 1 && !feature.is_uncut &&
                       feature.new_area_m2 > kMostOfFacet * facet_m2;
  if (!is_most) return gone;
  if (carries_outline(task, *host))
    return {std::nullopt, "an outline on its wall or roof would not move along"};
  const double depth_m = extents_of(*host, task.segmentation, feature).depth();
  const double trimmed_m3 = std::min(feature.volume_m3, feature.new_area_m2 * depth_m);
  const double by_m = trimmed_m3 / facet_m2;
  MovedFacet moved =
      move_facet(task.solid, host->facet, feature.sense == Sense::protrusion ? by_m : -by_m);
  gone.solid = std::move(moved.solid);
  gone.reason = std::move(moved.reason);
  return gone;
}

}  // namespace oriel
