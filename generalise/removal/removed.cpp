#include "generalise/removal/removed.h"

#include <cstdint>

namespace oriel {

void count_removed(const std::vector<FeatureId>& removed, const Segmentation& segmentation,
                   const Interpretation& interpretation, Redrawn& redrawn) {
  double volume_m3 = 0;
  for (const FeatureId id : removed) {
    ++redrawn.removed[interpretation.verdicts[id.index()].label];
    volume_m3 += segmentation.features[id.index()].volume_m3;
  }
  auto& attributes = redrawn.labelled.attributes;
  for (const auto& [label, count] : redrawn.removed)
    attributes.emplace_back("oriel_removed_" + (label.empty() ? "unknown" : label),
                            std::int64_t{count});
  if (!redrawn.removed.empty()) attributes.emplace_back("oriel_removed_volume_m3", volume_m3);
}

}  // namespace oriel
