#pragma once

#include "kernel/base/random.h"
#include "kernel/model/vec3.h"
#include "kernel/perturb/perturb.h"

#include <vector>

namespace oriel::detail {

/// How far noise moves each vertex: those closer than 1 mm, and those that such pairs link, alike.
/// Drawn in the order of the vertices' places, so that their numbers do not matter.
std::vector<Vec3> corner_noise(const std::vector<Vec3>& vertices, double noise_m, NoiseKind kind,
                               Random random);

}  // namespace oriel::detail
