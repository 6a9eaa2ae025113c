#pragma once

#include "kernel/model/vec3.h"
#include "kernel/segment/boundary/number_map.h"

#include <array>
#include <cstdint>

namespace oriel::detail {

/// How a pocket is another one, the model, moved by a whole number of grid units: so every answer
/// about the one is that about the other.
struct Congruence {
  std::array<std::int64_t, 3> shift{};  ///< in grid units
  Vec3 shift_m;
  NumberMap points;   ///< of the model, of the other
  NumberMap planes;   ///< likewise
  NumberMap sources;  ///< of their facets, likewise
  NumberMap marks;    ///< features with marks on their facets, likewise
};

}  // namespace oriel::detail
