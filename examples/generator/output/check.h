#pragma once

#include "examples/generator/house/body.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::generator {

/// What is wrong with a body, one sentence each; empty if it is a solid with complete truth:
///  1. every ring has at least three corners and meets none of them twice;
///  2. every edge is shared by exactly two polygons, in opposite directions;
///  3. the polygons around every vertex form one fan, and all polygons hang together;
///  4. polygons are planar within `flatness`, if that is asked, and holes run against their outer
///     ring;
///  5. the volume is positive;
///  6. every object has polygons, and every host and parent exists.
std::vector<std::string> find_faults(const Body& body, std::optional<Um> flatness);

}  // namespace oriel::generator
