#pragma once

#include "kernel/perturb/motion.h"
#include "model/building.h"
#include "model/vec3.h"

#include <cstdint>
#include <vector>

namespace oriel {

/// How far noise moves a coordinate.
enum class NoiseKind {
  /// By at most Perturbation::noise_m, anything up to it as likely as anything else: as
  /// `oriel-generate --noise` does.
  uniform,
  /// By a sum of twelve uniform numbers, which is nearly normal, with Perturbation::noise_m as
  /// its standard deviation and never more than six times that. No function of the mathematics
  /// library is asked, so that the bytes are the same everywhere.
  normal
};

/// What is done to a building to see whether its labels withstand it. The default does nothing.
struct Perturbation {
  /// Of all that is drawn. Buildings are told apart by their ids, so one building is perturbed the
  /// same way in whatever company it comes.
  std::uint64_t seed = 1;
  /// At least 0.
  double noise_m = 0;
  NoiseKind noise_kind = NoiseKind::uniform;
  /// About the upright axis through the middle of the box of all vertices, counter-clockwise seen
  /// from above. Quarter turns are exact.
  double rotation_deg = 0;
  /// The whole building is moved by this: the grid that it is rounded to lies otherwise in it.
  Vec3 shift_m;
  /// The share of polygons that are missing, 0…1. Of a larger share the polygons of a smaller one
  /// are missing, too.
  double missing_share = 0;
  /// Every polygon is cut into triangles without new vertices, in a random way.
  bool triangulates = false;
};

struct Perturbed {
  Building building;
  Motion motion;
  /// By Polygon::source of `building`: the source of the input's polygon. Without triangles they
  /// are the same. Of the triangles of a polygon the first keeps its source, and the others have
  /// sources beyond all of the input's, as no two polygons of a building may share one.
  std::vector<int> source_before;
};

/// The building with what `perturbation` asks for, in this order: polygons are taken out; the
/// building is turned and shifted; vertices are moved at random; polygons are cut into triangles (a
/// building without noise before it is turned, since rounded corners that were in line would make
/// slivers; one with noise last, since triangles that are shaken would fold over each other).
///
/// What is one corner stays one: vertices that are closer than 1 mm, which reading them as a solid
/// would weld, move together. A polygon that cannot be cut, as its rings cross or touch, stays
/// whole. Polygons keep their order, body, shell and hint; triangles stand in the place of theirs.
/// The frame follows the vertices. Id, level of detail and joined installations stay;
/// Building::repeats stay with the polygons that do, but for triangulated buildings.
///
/// The result depends on the building and the perturbation only. What is drawn for noise, for
/// missing polygons and for triangles does not change with the other two; noise does not depend on
/// the order of vertices.
Perturbed perturbed(const Building& building, const Perturbation& perturbation);

}  // namespace oriel
