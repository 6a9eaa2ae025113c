#include "generalise/operators/omit.h"

#include "generalise/removal/fill_rings.h"
#include "generalise/removal/remove_cells.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace oriel {

Remainder omit(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
               const SegmentOptions& options, const Judge& judge) {
  const double half_m3 = volume_m3(solid) / 2;
  std::vector<FeatureId> features;
  std::vector<Refusal> refused;
  for (const Step& step : plan.steps) {
    if (step.operation != "omit") continue;
    const Feature& feature = segmentation.features[step.feature.index()];
    if (feature.sense == Sense::protrusion && feature.volume_m3 > half_m3)
      refused.push_back({step.feature, "more than half of the building would go"});
    else
      features.push_back(step.feature);
  }
  Remainder remainder = remove_features(solid, segmentation, features, options);
  if (judge)
    remainder = remove_cells(solid, segmentation, std::move(remainder), judge,
                             kGapOnMap_m * plan.scale, options);
  remainder = fill_rings(segmentation, std::move(remainder), judge, options);
  remainder.refused.insert(remainder.refused.end(), refused.begin(), refused.end());
  std::ranges::sort(remainder.refused, {}, &Refusal::feature);
  return remainder;
}

}  // namespace oriel
