#include "generalise/operators/omit.h"

#include <vector>

namespace oriel {

Remainder omit(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
               const SegmentOptions& options) {
  std::vector<FeatureId> features;
  for (const Step& step : plan.steps)
    if (step.operation == "omit") features.push_back(step.feature);
  return remove_features(solid, segmentation, features, options);
}

}  // namespace oriel
