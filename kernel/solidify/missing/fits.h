#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <span>

namespace oriel::detail {

/// True if none of the soup's polygons without source runs through another polygon, or lies on one,
/// by more than `reach` (grid units). False once `work` is used up.
bool fits(const Soup& soup, std::span<const PolygonShape> shapes, double reach, Work& work);

}  // namespace oriel::detail
