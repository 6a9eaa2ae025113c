#include "oriel/pipeline/targets.h"

#include "kernel/base/index.h"

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
                            const Building& building, const Solid& solid) {
  if (invariants.limits.party_walls_pct)
    invariants.party_walls = party_walls(building, solid, document.buildings);
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

}  // namespace oriel
