#pragma once

#include "io/json/text.h"
#include "model/building.h"

#include <optional>
#include <vector>

namespace oriel::detail {

/// Beyond these a coordinate or a building is taken for a mistake.
constexpr double kMaxCoordinate_m = 1e9;
constexpr double kMaxExtent_m = 4000;

/// `ring` without vertices that repeat the one before them, and without a last one that repeats the
/// first. What was dropped is added to `repeats`, as of ring `number` of polygon `polygon`.
std::vector<int> without_repeats(std::vector<int> ring, int polygon, int number,
                                 std::vector<RepeatedVertex>& repeats);

/// E311 if rings of `polygons` have fewer than three distinct points. They stay: to drop them is
/// the affair of solidify, and polygons keep their numbers.
std::optional<Fault> find_degenerate(const std::vector<Polygon>& polygons,
                                     const std::vector<Vec3>& points);

/// E506 if a point (in the input's coordinates) is not finite or too far out, E501 if they are too
/// far apart for one building.
std::optional<Fault> find_beyond_limits(const std::vector<Vec3>& points);

}  // namespace oriel::detail
