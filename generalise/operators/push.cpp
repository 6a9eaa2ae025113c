#include "generalise/operators/push.h"

#include "generalise/operators/facade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// What the step asks for (enlarge); nothing if it is large enough.
std::optional<Extents> asked_for(const Redrawing& task, const Host& host) {
  const Extents box = extents_of(host, task.segmentation, task.feature());
  const double more_u = std::max(0.0, task.to_m() - box.width());
  const double more_v = std::max(0.0, task.to_m() - box.height());
  if (more_u == 0 && more_v == 0) return std::nullopt;
  return grown(box, more_u, more_v, task.word("anchor", "centre") == "sill");
}

/// Where the feature has been drawn on a solid: all of the facets that have its polygons.
std::optional<Extents> drawn(const Solid& solid, const Host& host, const Feature& feature) {
  std::vector<Vec3> points;
  for (const Facet& facet : solid.facets) {
    if (facet.polygons != feature.source_polygons) continue;
    for (const Loop& loop : facet.loops)
      for (const int v : loop) points.push_back(solid.vertices[static_cast<std::size_t>(v)].point);
  }
  return points.empty() ? std::nullopt : std::optional(extents_of(host, points));
}

class PushFinder {
 public:
  PushFinder(const Segmentation& segmentation, const std::vector<Step>& steps, double scale,
             const std::vector<FeatureId>& excluded)
      : segmentation_(segmentation), steps_(steps), scale_(scale), excluded_(excluded) {}

  std::vector<Push> run() {
    std::map<WallKey, std::vector<Step>> walls;
    for (const Step& step : steps_)
      if (step.operation == "enlarge" && step.openings && is_recess(step.feature))
        walls[key_of(step.feature)].push_back(step);
    std::vector<Push> found;
    for (const auto& [key, steps] : walls) {
      Push push{steps, pushed_by(steps, key)};
      if (!push.pushed.empty()) found.push_back(std::move(push));
    }
    std::ranges::sort(found, {}, [](const Push& push) { return push.by.front().feature; });
    return found;
  }

 private:
  /// The wall plane.
  using WallKey = std::tuple<std::array<std::int64_t, 3>, std::int64_t>;

  [[nodiscard]] const Feature& feature(FeatureId id) const {
    return segmentation_.features[id.index()];
  }
  [[nodiscard]] bool is_recess(FeatureId id) const {
    return feature(id).sense == Sense::hole && !feature(id).planes.empty();
  }
  [[nodiscard]] const Plane& plane_of(FeatureId id) const {
    return segmentation_.planes[feature(id).planes[0].index()];
  }
  [[nodiscard]] WallKey key_of(FeatureId id) const {
    return {plane_of(id).coefficients, plane_of(id).offset};
  }

  [[nodiscard]] std::vector<FeatureId> candidates(const std::vector<FeatureId>& openings,
                                                  const WallKey& key) const {
    std::vector<FeatureId> some;
    for (const FeatureId id : openings)
      if (is_recess(id) && key_of(id) == key && !std::ranges::binary_search(excluded_, id) &&
          std::ranges::find(steps_, id, &Step::feature) == steps_.end())
        some.push_back(id);
    return some;
  }

  [[nodiscard]] std::vector<Step> pushed_by(const std::vector<Step>& by, const WallKey& key) const {
    const auto host = wall_axes(plane_of(by.front().feature));
    const std::vector<FeatureId> openings = candidates(*by.front().openings, key);
    if (!host || openings.empty()) return {};
    std::vector<Movable> movables;
    for (const FeatureId id : openings)
      movables.push_back({extents_of(*host, segmentation_, feature(id)), 0, false});
    const Redrawing first{no_solid_, segmentation_, {by.front()}, scale_};
    for (const Step& step : by)
      if (const auto box = asked_for({no_solid_, segmentation_, {step}, scale_}, *host))
        movables.push_back({*box, 0, true});
    if (movables.size() == openings.size()) return {};
    const FacadePlaces found = FacadeRoom().arrange(movables, first.gap_m(), Apartness::as_now);
    std::vector<Step> pushed;
    for (std::size_t i = 0; i < openings.size() && found.has_room(); ++i)
      if (is_moved(movables[i].box, found.places[i]))
        pushed.push_back({openings[i], "displace", by.front().rule, {{"gap", first.gap_m()}}});
    return pushed;
  }

  const Segmentation& segmentation_;
  const std::vector<Step>& steps_;
  double scale_;
  const std::vector<FeatureId>& excluded_;
  Solid no_solid_;
};

/// Those of one facet; what cannot be put back is left.
void push_on_facet(const Redrawing& task, const Host& host, const std::vector<std::size_t>& members,
                   const std::vector<Step>& by, Placed& out) {
  std::vector<Movable> movables;
  for (const std::size_t i : members)
    movables.push_back({extents_of(host, task.segmentation, task.feature(i)), 0, false});
  for (const Step& step : by)
    if (const auto box = drawn(task.solid, host, task.segmentation.features[step.feature.index()]))
      movables.push_back({*box, 0, true});
  const FacadePlaces found = FacadeRoom(task.solid, task.segmentation, host)
                                 .arrange(movables, task.gap_m(), Apartness::as_now);
  for (std::size_t m = 0; m < members.size(); ++m) {
    const Feature& feature = task.feature(members[m]);
    const auto depth_m = box_depth(host, feature, movables[m].box);
    if (!found.has_room() || !depth_m || !is_moved(movables[m].box, found.places[m])) {
      out.left.push_back({members[m], "it cannot be pushed", false, {}});
      continue;
    }
    Placed placed = put_on_facade(*out.solid, task.segmentation, host, found.places[m], *depth_m,
                                  found.clear_m[m], feature);
    if (placed.solid)
      out.solid = std::move(placed.solid);
    else
      out.left.push_back({members[m], std::move(placed.reason), false, {}});
  }
}

}  // namespace

std::vector<Push> pushes_of(const Segmentation& segmentation, const std::vector<Step>& steps,
                            double scale, const std::vector<FeatureId>& excluded) {
  return PushFinder(segmentation, steps, scale, excluded).run();
}

Placed push_aside(const Redrawing& task, const std::vector<Step>& by) {
  Placed out{task.solid, {}, false};
  std::map<FacetId, std::vector<std::size_t>> facades;
  for (std::size_t i = 0; i < task.steps.size(); ++i)
    if (const auto host = task.host(i))
      facades[host->facet].push_back(i);
    else
      out.left.push_back({i, "its wall is no longer found", false, {}});
  for (const auto& [facet, members] : facades)
    push_on_facet(task, *task.host(members.front()), members, by, out);
  if (!out.left.empty()) out.solid.reset();
  return out;
}

}  // namespace oriel::detail
