#pragma once

#include "kernel/attach/attach.h"
#include "model/solid.h"
#include "model/vec3.h"

#include <map>
#include <span>
#include <utility>

namespace oriel {

/// Parts of facets smaller than this are not met but touched.
inline constexpr double kTouch_m2 = 1e-9;

/// How near two segments come to each other.
double distance(std::pair<Vec3, Vec3> p, std::pair<Vec3, Vec3> q);

/// How near an outline comes to an edge.
double nearness(std::span<const Vec3> outline, std::pair<Vec3, Vec3> edge);

/// How near it may come to an edge: what `before` came nearer to it may come as near to, but for
/// half of what vertices are welded at.
double needed_m(const Clearance& clearance, std::pair<Vec3, Vec3> edge);

/// What comes as near to an edge as `near_m` comes too near. What was there before is looked at
/// only if it can matter.
bool is_too_near(const Clearance& clearance, double near_m, std::pair<Vec3, Vec3> edge);

/// Edges of a result are no shorter: what is nearer becomes one vertex when it is read again.
inline constexpr double kLeastEdge_m = 0.001;

/// By vertex of a facet where it goes.
using Moves = std::map<int, Vec3>;

/// Something lies in the way of a facet whose vertices move: another vertex, or a part of a facet
/// that has none of them, in the box in the facet's own axes around where they are and where they
/// go.
bool is_in_the_way(const Solid& solid, FacetId facet, const Moves& moves);

}  // namespace oriel
