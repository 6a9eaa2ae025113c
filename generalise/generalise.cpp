#include "generalise/generalise.h"

#include "generalise/operators/omit.h"

#include <fmt/format.h>

namespace oriel {

namespace {

Issue refusal_issue(const Refusal& refusal, const Segmentation& segmentation,
                    const FeatureTable& table, const Interpretation& interpretation,
                    const std::string& target) {
  const FeatureId parent = segmentation.features[refusal.feature.index()].parent;
  const std::string& label = interpretation.verdicts[refusal.feature.index()].label;
  const bool is_piece = parent.is_valid() && label.empty();
  Issue issue =
      building_issue(is_piece ? Severity::note : Severity::warning, "G401", table.building(),
                     is_piece ? fmt::format("is a piece of {} and stays with it at {}: {}",
                                            table.id(parent), target, refusal.reason)
                              : fmt::format("is not omitted at {}: {}", target, refusal.reason));
  issue.place.feature = table.id(refusal.feature);
  return issue;
}

}  // namespace

Checked<Generalised> generalise(const Solid& solid, const Segmentation& segmentation,
                                const FeatureTable& table, const Interpretation& interpretation,
                                const Plan& plan, const SegmentOptions& options) {
  Checked<Generalised> out;
  const std::string target =
      plan.scale > 0 ? fmt::format("1:{}", plan.scale) : std::string("this level of detail");
  Remainder remainder = omit(solid, segmentation, plan, options);
  for (const Refusal& refusal : remainder.refused)
    out.issues.push_back(refusal_issue(refusal, segmentation, table, interpretation, target));
  if (remainder.solid.facets.empty() || volume_m3(remainder.solid) <= 0 ||
      !is_closed(remainder.solid)) {
    out.issues.push_back(building_issue(
        Severity::error, "G402", table.building(),
        fmt::format("nothing closed would be left at {}; it stays as it is", target)));
    return out;
  }
  out.value = Generalised{std::move(remainder.solid), std::move(remainder.removed),
                          std::move(remainder.refused)};
  return out;
}

}  // namespace oriel
