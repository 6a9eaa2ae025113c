#pragma once

#include "kernel/perturb/motion.h"
#include "kernel/perturb/perturb.h"  // IWYU pragma: export
#include "model/building.h"
#include "oriel/result.h"

#include <vector>

namespace oriel {

/// The boxes of a perturbed building's features where they were before it was moved, by feature, in
/// the input's coordinates: what truth is compared with. `result` is what segment() or label() said
/// of `perturbed.building`, is_done(). Where nothing was turned or shifted these are the boxes that
/// feature_records() gives.
std::vector<Box> boxes_before(const PipelineResult& result, const Perturbed& perturbed);

}  // namespace oriel
