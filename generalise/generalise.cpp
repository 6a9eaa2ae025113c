#include "generalise/generalise.h"

#include "generalise/operators/omit.h"

#include <fmt/format.h>

namespace oriel {

Checked<Generalised> generalise(const Solid& solid, const Segmentation& segmentation,
                                const FeatureTable& table, const Plan& plan,
                                const SegmentOptions& options) {
  Checked<Generalised> out;
  Remainder remainder = omit(solid, segmentation, plan, options);
  for (const Refusal& refusal : remainder.refused) {
    Issue issue =
        building_issue(Severity::warning, "G401", table.building(),
                       fmt::format("is not omitted at 1:{}: {}", plan.scale, refusal.reason));
    issue.place.feature = table.id(refusal.feature);
    out.issues.push_back(std::move(issue));
  }
  if (remainder.solid.facets.empty() || volume_m3(remainder.solid) <= 0 ||
      !is_closed(remainder.solid)) {
    out.issues.push_back(building_issue(
        Severity::error, "G402", table.building(),
        fmt::format("nothing closed would be left at 1:{}; it stays as it is", plan.scale)));
    return out;
  }
  out.value = Generalised{std::move(remainder.solid), std::move(remainder.removed)};
  return out;
}

}  // namespace oriel
