#include "oriel/drawing/targets.h"

#include "interpret/plan/plan.h"
#include "kernel/base/index.h"
#include "model/tolerances.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace oriel {

double least_edge_m(const Profile* profile, std::optional<double> scale) {
  if (profile != nullptr && profile->edge_min_m) return *profile->edge_min_m;
  const auto sizes = profile != nullptr ? profile->thresholds(scale) : std::nullopt;
  return sizes ? sizes->c_m : kGapOnMap_m * scale.value_or(0);
}

RedrawContext redraw_context(const Building& building, const PipelineResult& result,
                             const LabelledBuilding& labelled, const PipelineOptions& options) {
  return {building,
          labelled,
          *result.solid,
          *result.segmentation,
          result.description.table,
          result.interpretation,
          segment_options(options, result.tolerances)};
}

Plan plan_at(const RuleBase& rules, const Profile* profile, const PipelineResult& result,
             std::optional<double> scale) {
  const auto& [table, graph, issues] = result.description;
  Plan asked;
  if (scale) asked = plan(rules, table, graph, result.interpretation, *scale);
  if (profile == nullptr) return asked;
  return plan_by_profile(std::move(asked), *profile, rules, *result.segmentation, table,
                         result.interpretation, scale);
}

Invariants invariants_of(const Profile* profile, const RuleBase& rules,
                         std::optional<double> scale) {
  Invariants invariants;
  invariants.limits = rules.limits();
  if (profile != nullptr) invariants.limits = stricter(invariants.limits, profile->limits);
  // Blocks have edges of their own, and what asks for edges everywhere takes their owners off.
  if (profile == nullptr || (profile->form == Profile::Form::as_is && !profile->edge_min_m))
    invariants.least_edge_m = least_edge_m(profile, scale);
  return invariants;
}

Invariants with_party_walls(Invariants invariants, const Document& document,
                            const Building& building, const PipelineResult& result) {
  if (result.surroundings) {
    // A chimney flush with the wall may go; the wall itself may not move.
    constexpr double kPartyWalls_pct = 1;
    if (!invariants.limits.party_walls_pct) invariants.limits.party_walls_pct = kPartyWalls_pct;
    for (const NeighbourWall& wall : result.surroundings->walls)
      invariants.party_walls.push_back({wall.outlines, wall.normal});
  } else if (invariants.limits.party_walls_pct) {
    invariants.party_walls = party_walls(building, *result.solid, document.buildings);
  }
  return invariants;
}

namespace {

Box box_around(const Building& building) {
  Box box;
  for (const Polygon& polygon : building.polygons)
    for (const auto& ring : polygon.rings)
      for (const int vertex : ring) box.grow(building.vertices[at(vertex)]);
  return box;
}

/// The boxes of all buildings of a document but one, in the coordinates of that.
std::vector<Box> boxes_of_others(const Document& document, const Building& building) {
  std::vector<Box> boxes;
  for (const Building& other : document.buildings)
    if (other.id != building.id)
      boxes.push_back(box_around(other).moved(other.frame.origin_m - building.frame.origin_m));
  return boxes;
}

/// Both ends lie on a wall of another building, seen from above, and so does the middle.
bool is_along(const NeighbourWall& wall, Vec3 from, Vec3 to) {
  Vec3 a, b;
  double most_m = -1;
  const Outline& outline = wall.outlines[0];
  for (const Vec3 p : outline)
    for (const Vec3 q : outline) {
      const Vec3 level{q.x - p.x, q.y - p.y, 0};
      if (length(level) <= most_m) continue;
      most_m = length(level);
      a = {p.x, p.y, 0};
      b = {q.x, q.y, 0};
    }
  if (!(most_m > 0)) return false;
  const Vec3 along = normalised(b - a);
  const auto across_m = [&](Vec3 p) { return length(cross(Vec3{p.x, p.y, 0} - a, along)); };
  if (across_m(from) > kContact_m || across_m(to) > kContact_m) return false;
  const auto at_m = [&](Vec3 p) { return dot(Vec3{p.x, p.y, 0} - a, along); };
  const auto [low_m, high_m] = std::minmax(at_m(from), at_m(to));
  return std::min(high_m, most_m) - std::max(low_m, 0.0) > kContact_m;
}

}  // namespace

std::function<bool(const Box& local_m)> free_ground(const Document& document,
                                                    const Building& building) {
  if (document.buildings.size() < 2) return {};
  // Most buildings never ask.
  return
      [&document, &building, others = std::optional<std::vector<Box>>()](const Box& asked) mutable {
        if (!others) others = boxes_of_others(document, building);
        return std::ranges::none_of(*others, [&](const Box& box) {
          return box.min.x <= asked.max.x && asked.min.x <= box.max.x && box.min.y <= asked.max.y &&
                 asked.min.y <= box.max.y;
        });
      };
}

PlanLimits plan_limits(const Document& document, const Building& building,
                       const PipelineResult& result, const NeighbourSearch* neighbours) {
  if (neighbours == nullptr || !result.surroundings) return {free_ground(document, building), {}};
  const Neighbourhood& around = *result.surroundings;
  PlanLimits limits;
  limits.may_cover = [neighbours, &around](const Box& asked) {
    return !neighbours->is_built_on(around, asked);
  };
  limits.is_shared = [&around](Vec3 from, Vec3 to) {
    return std::ranges::any_of(around.walls,
                               [&](const NeighbourWall& wall) { return is_along(wall, from, to); });
  };
  return limits;
}

}  // namespace oriel
