#pragma once

#include "kernel/geometry/exact.h"
#include "kernel/model/building.h"
#include "kernel/model/issue.h"
#include "kernel/model/tolerances.h"

#include <vector>

namespace oriel::detail {

/// A welded polygon: rings index Soup::points, each at least a triangle, without repeated
/// neighbours.
struct SoupPolygon {
  std::vector<std::vector<int>> rings;
  int source = -1;
  int body = 0;
  int shell = 0;
};

/// Welded polygons on the grid, in canonical order: points by coordinates, rings from their
/// smallest vertex, polygons by their rings. The order of the input has left no trace but
/// SoupPolygon::source.
struct Soup {
  double grid_m = 0;
  std::vector<exact::GridPoint> points;
  std::vector<SoupPolygon> polygons;
};

/// The grid for a weld distance: the largest power of two ≤ weld_m / 1024, in metres.
double grid_for(double weld_m);

/// Rounds the vertices to the grid, unites those closer than weld_m, and drops what becomes
/// degenerate (E304).
Soup weld(const Building& building, const Tolerances& tolerances, std::vector<Issue>& issues);

}  // namespace oriel::detail
