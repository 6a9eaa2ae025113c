#include "experiments/perturb.h"

#include "kernel/base/index.h"

namespace oriel {

std::vector<Box> boxes_before(const PipelineResult& result, const Perturbed& perturbed) {
  const Vec3 origin = perturbed.building.frame.origin_m;
  const Segmentation& segmentation = *result.segmentation;
  std::vector<Box> boxes;
  for (const Feature& feature : segmentation.features) {
    if (perturbed.motion.is_still()) {
      boxes.push_back(feature.box.moved(origin));
      continue;
    }
    std::vector<Vec3> points;
    for (const int v : feature.vertices)
      points.push_back(segmentation.vertices[at(v)].point + origin);
    boxes.push_back(box_before(perturbed.motion, points));
  }
  return boxes;
}

}  // namespace oriel
