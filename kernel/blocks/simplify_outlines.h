#pragma once

#include "kernel/geometry/planar.h"
#include "model/vec3.h"

#include <functional>
#include <vector>

namespace oriel {

/// How outlines in the plan are simplified.
struct OutlineLimits {
  /// Edges that are shorter by more than the reach go, where they can.
  double least_edge_m = 0;
  /// Nothing comes nearer to anything else; what lies this near to a straight edge is on it.
  double reach_m = 0;
  /// True if nothing else stands in the box: the outlines may come to cover more of it than they
  /// did, within the box around all of them, so that two neighbours never take the same ground.
  /// Null: they only ever cover less.
  std::function<bool(const Box& gained)> may_cover;
  /// True if an edge stays as it is, with its ends. Null: none must.
  std::function<bool(Vec3 from, Vec3 to)> is_fixed{};
};

/// Takes short edges off the outlines, z = 0, of one or more areas with their interior to the left,
/// the shortest first, by the operation that changes the least ground:
///
/// - a step: the shorter of the parts before and behind it follows the longer one, shifted parallel
///   to itself, unless it would come to lie as far as the least edge is long from where the
///   outlines were;
/// - a protrusion or a niche, whose sides run against each other: it is cut off, or filled, unless
///   it covers as much as the square of the least edge: then it is a part of the building;
/// - a corner that is cut off: the edges beside it are drawn on until they meet, with the same
///   limit.
///
/// No edge gets a new direction, so right angles stay right. Outlines neither vanish nor touch
/// themselves or each other if they did not. Returns how many short edges are left. Source: the
/// short facade elements of Staufenbiel 1973, as Sester 2005 uses them (Optimization approaches for
/// generalization and data abstraction).
int simplify_outlines(std::vector<Outline>& outlines, const OutlineLimits& limits);

}  // namespace oriel
