#include "interpret/labelling/main_parts.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <limits>

namespace oriel::detail {

MainParts::MainParts(const Segmentation& segmentation, const FeatureTable& table,
                     const Profile::MainPart& part, const Thresholds& sizes)
    : segmentation_(segmentation), table_(table), part_(part), sizes_(sizes) {
  for (const Cell& cell : segmentation.cells) building_m3_ += cell.sign * cell.volume_m3;
}

bool MainParts::has(FeatureId id) const {
  if (building_m3_ <= sizes_.area_m2 * sizes_.c_m) return true;
  const auto height = table_.number(id, Attribute::height);
  const auto a = table_.number(id, Attribute::a), b = table_.number(id, Attribute::b),
             c = table_.number(id, Attribute::c);
  if (!height || !a || !b || !c || *height <= 0) return false;
  const Feature& feature = segmentation_.features[id.index()];
  const bool is_storey = *height >= part_.height_m && feature.volume_m3 >= part_.area_m2 * *height;
  const bool is_roof = feature.sense == Sense::protrusion &&
                       *a * *b * *c >= sizes_.area_m2 * *height;  // the standing box in plan
  return is_storey || is_roof;
}

FeatureId MainParts::holder_of_ridge(const std::vector<char>& goes,
                                     const std::vector<char>& goes_for_size) const {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  double rest_m = kNone;
  for (const Cell& cell : segmentation_.cells) {
    if (cell.sign < 0 || (cell.feature.is_valid() && goes[cell.feature.index()] != 0)) continue;
    for (const Facet& facet : cell.facets)
      for (const int v : facet.loops[0])
        rest_m = std::max(rest_m, segmentation_.vertices[at(v)].point.z);
  }
  FeatureId highest;
  double top_m = rest_m + sizes_.c_m;
  if (rest_m == kNone) return highest;
  for (int i = 0; i < std::ssize(segmentation_.features); ++i) {
    const Feature& feature = segmentation_.features[at(i)];
    if (goes_for_size[at(i)] == 0 || feature.sense != Sense::protrusion) continue;
    if (feature.box.max.z <= top_m) continue;
    top_m = feature.box.max.z;
    highest = FeatureId{i};
  }
  return highest;
}

}  // namespace oriel::detail
