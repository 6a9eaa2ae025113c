#include "generalise/feature_outcome.h"

#include "generalise/invariants/invariants.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>

namespace oriel {

std::vector<FeatureOutcome> feature_outcomes(const Plan& plan, const Generalised& generalised,
                                             const FeatureTable& table,
                                             const Interpretation& interpretation) {
  std::vector<FeatureOutcome> outcomes;
  for (int i = 0; i < static_cast<int>(table.rows()); ++i) {
    const FeatureId id{i};
    FeatureOutcome one;
    one.feature = table.id(id);
    one.label = interpretation.verdicts[id.index()].label;
    const auto step = std::ranges::find(plan.steps, id, &Step::feature);
    const auto refused = std::ranges::find(generalised.refused, id, &CarriedOut::Refused::feature);
    const bool is_gone = std::ranges::binary_search(generalised.removed, id);
    if (step != plan.steps.end()) {
      one.operation = step->operation;
      one.rule = step->rule;
    }
    if (is_gone)
      one.outcome =
          one.operation == "omit" || one.operation == "flatten" ? "omitted" : "went along";
    else if (std::ranges::binary_search(generalised.changed, id))
      one.outcome = "changed";
    else if (refused != generalised.refused.end()) {
      one.outcome = is_part(*refused, plan, interpretation) ? "kept" : "refused";
      one.code = refused->code;
      one.reason = refused->reason;
    } else {
      one.outcome = "kept";
    }
    outcomes.push_back(std::move(one));
  }
  return outcomes;
}

SolidFigures figures_of(const Solid& solid, double least_edge_m) {
  SolidFigures out;
  out.facets = solid.facets.size();
  std::set<std::array<std::int64_t, 3>> normals;
  std::size_t half_edges = 0;
  for (const Facet& facet : solid.facets) {
    normals.insert(solid.planes[facet.plane.index()].coefficients);
    for (const Loop& loop : facet.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 p = solid.vertices[static_cast<std::size_t>(loop[i])].point;
        const Vec3 q = solid.vertices[static_cast<std::size_t>(loop[(i + 1) % loop.size()])].point;
        if (length(q - p) < least_edge_m) ++half_edges;
      }
  }
  out.normals = normals.size();
  out.short_edges = half_edges / 2;  // each edge is met from two facets
  const Measures measures = measures_of(solid);
  out.volume_m3 = measures.volume_m3;
  out.footprint_m2 = measures.footprint_m2;
  return out;
}

}  // namespace oriel
