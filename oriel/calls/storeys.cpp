#include "model/description/attributes.h"
#include "model/segmentation.h"
#include "oriel/explain.h"

#include <algorithm>
#include <cstddef>
#include <map>

namespace oriel {

namespace {

struct StoreyReach {
  double low = Box::kInfinity;
  double high = -Box::kInfinity;
};

}  // namespace

std::vector<double> storey_floors(const Building& building, const PipelineResult& result) {
  std::map<double, StoreyReach> storeys;
  if (!result.is_done()) return {};
  for (std::size_t i = 0; i < result.segmentation->features.size(); ++i) {
    const auto storey =
        result.description.table.number(FeatureId{static_cast<int>(i)}, Attribute::storey);
    if (!storey) continue;
    const Box& box = result.segmentation->features[i].box;
    StoreyReach& reach = storeys[*storey];
    reach.low = std::min(reach.low, box.min.z);
    reach.high = std::max(reach.high, box.max.z);
  }
  Box all;
  for (const Vec3& vertex : building.vertices) all.grow(vertex);
  std::vector<double> floors;
  double top = all.min.z;
  for (const auto& [number, reach] : storeys) {
    floors.push_back(floors.empty() ? top : (top + reach.low) / 2);
    top = reach.high;
  }
  return floors;
}

}  // namespace oriel
