#pragma once

#include "kernel/model/vec3.h"

#include <utility>

namespace oriel::detail {

/// Parts of facets smaller than this are not met but touched.
inline constexpr double kTouch_m2 = 1e-9;

/// How near two segments come to each other.
double distance(std::pair<Vec3, Vec3> p, std::pair<Vec3, Vec3> q);

}  // namespace oriel::detail
