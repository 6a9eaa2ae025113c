#pragma once

#include "generalise/context.h"
#include "interpret/pack/rule_base.h"
#include "interpret/plan/profile.h"
#include "io/document.h"
#include "kernel/neighbours/neighbours.h"
#include "oriel/options.h"
#include "oriel/result.h"

#include <functional>
#include <optional>

namespace oriel {

/// The least length that a target shows: the profile's, or its c, else 0.125 mm on the map.
double least_edge_m(const Profile* profile, std::optional<double> scale);

/// What a building is redrawn with of which label() said `result`, and annotate() `labelled`; all
/// outlive it.
RedrawContext redraw_context(const Building& building, const PipelineResult& result,
                             const LabelledBuilding& labelled, const PipelineOptions& options = {});

/// What the pack and the profile, which may be null, ask of a building at a target.
Plan plan_at(const RuleBase& rules, const Profile* profile, const PipelineResult& result,
             std::optional<double> scale);

/// What must not change at a target, by the profile and the pack; without a judge and party walls.
Invariants invariants_of(const Profile* profile, const RuleBase& rules,
                         std::optional<double> scale);

/// The same of a building, with the walls of other buildings that it stands against if they matter:
/// those of the document, or, if neighbours are known (PipelineResult::surroundings), all of them;
/// then they always matter, to a hundredth if nothing else is said.
Invariants with_party_walls(Invariants invariants, const Document& document,
                            const Building& building, const PipelineResult& result);

/// Whether a box of the building's plan is free of all other buildings of the document, seen from
/// above and by their boxes. Null if it has no others: then nobody knows what stands beside it.
/// Both outlive the answer.
std::function<bool(const Box& local_m)> free_ground(const Document& document,
                                                    const Building& building);

/// What a simpler footprint must leave as it is; all that it is made of outlives it.
struct PlanLimits {
  /// free_ground() of the document, or if neighbours are known of all buildings.
  std::function<bool(const Box& local_m)> may_cover{};
  /// Whether another building stands against an edge. Null: nobody knows.
  std::function<bool(Vec3 from, Vec3 to)> is_shared{};
};

PlanLimits plan_limits(const Document& document, const Building& building,
                       const PipelineResult& result, const NeighbourSearch* neighbours);

}  // namespace oriel
