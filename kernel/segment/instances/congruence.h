#pragma once

#include "kernel/segment/boundary/boundary.h"
#include "kernel/segment/boundary/number_map.h"

#include <array>
#include <cstdint>
#include <optional>

namespace oriel::detail {

/// How one body is another one, the model, moved by a whole number of grid units: so every answer
/// about the one is that about the other.
struct Congruence {
  std::array<std::int64_t, 3> shift{};  ///< in grid units
  Vec3 shift_m;
  NumberMap points;   ///< of the model, of the other
  NumberMap planes;   ///< likewise
  NumberMap sources;  ///< of their facets, likewise
  NumberMap marks;    ///< features with marks on their facets, likewise
};

/// Nothing if `other` is not `model` moved, facet by facet and edge by edge, or if they differ in
/// what a segmentation asks for beside the shape: facets made of unlike numbers of facets of the
/// solid, unlike marks, which facet lies in the ground (`ground`, -1: none).
std::optional<Congruence> find_congruence(const Boundary& model, const Boundary& other,
                                          Side ground);

}  // namespace oriel::detail
