#pragma once

#include "examples/generator/house/body.h"

namespace oriel::test {

/// How many edges of the triangulated body pierce one of its triangles. 0 for a body that does not
/// cross itself; what only touches is not counted. Quadratic, so for houses only. Throws
/// std::invalid_argument if a polygon is no triangle.
int count_crossings(const generator::Body& body);

}  // namespace oriel::test
