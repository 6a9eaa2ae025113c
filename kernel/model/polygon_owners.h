#pragma once

#include "kernel/model/segmentation.h"

#include <cstddef>
#include <vector>

namespace oriel {

/// For each polygon (Polygon::source, below `polygons`) the features that list it, the smallest
/// first: by volume, where an imprint is as large as what it owns; of equal sizes the one with
/// fewer polygons, which is the inner one, then the later one. Throws std::logic_error if a feature
/// lists a polygon beyond.
std::vector<std::vector<int>> polygon_owners(const Segmentation& segmentation,
                                             std::size_t polygons);

}  // namespace oriel
