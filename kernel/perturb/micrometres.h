#pragma once

#include "kernel/model/vec3.h"
#include "kernel/model/whole_point.h"

#include <cmath>
#include <cstdint>

namespace oriel::detail {

inline constexpr double kMicrometresInMetre = 1e6;

/// The nearest whole number of micrometres, or point of such.
inline std::int64_t in_micrometres(double metres) {
  return std::llround(metres * kMicrometresInMetre);
}
inline MicrometrePoint in_micrometres(Vec3 metres) {
  return {{in_micrometres(metres.x), in_micrometres(metres.y), in_micrometres(metres.z)}};
}

}  // namespace oriel::detail
