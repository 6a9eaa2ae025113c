#pragma once

#include "examples/generator/geometry/point.h"
#include "examples/generator/geometry/points_on_edges.h"

#include <utility>
#include <vector>

namespace oriel::generator {

/// A directed edge and a closed polyline, as indices of points.
using Edge = std::pair<int, int>;
using Loop = std::vector<int>;

/// The loop with every point that lies on one of its edges.
Loop split(const Loop& loop, const PointsOnEdges& points);

/// What is left of the loops' edges once those that run along each other in opposite directions
/// have cancelled; sorted.
std::vector<Edge> boundary(const std::vector<Loop>& loops);

/// Joins sorted edges of one plane to closed loops, with the area on their left seen against
/// `normal`. Where loops meet at a corner the leftmost turn is taken, so that a facet pinched there
/// falls into two. Edges that do not close are left out.
std::vector<Loop> trace(const std::vector<Point>& points, Vec3 normal,
                        const std::vector<Edge>& edges);

/// Twice the loop's area times its normal, in square metres.
Vec3 doubled_area(const std::vector<Point>& points, const Loop& loop);

/// Sorts loops into polygons: counter-clockwise ones are outer rings, each followed by the
/// clockwise ones that lie in it.
std::vector<std::vector<Loop>> nest(const std::vector<Point>& points, Vec3 normal,
                                    std::vector<Loop> loops);

}  // namespace oriel::generator
