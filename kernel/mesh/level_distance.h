#pragma once

#include "model/solid.h"

#include <memory>

namespace oriel {

/// The surface of one form of a building, prepared to be compared with several others.
class LevelSurface {
 public:
  /// `level` is not empty.
  explicit LevelSurface(Solid level);

 private:
  friend double level_distance_m(const LevelSurface& a, const LevelSurface& b, double error_m);
  struct Parts;
  std::shared_ptr<const Parts> parts_;
};

/// The symmetric Hausdorff distance of two forms of one building in m, no further off than
/// `error_m`, as hausdorff_m() measures it, but quick where most facets of one are facets of the
/// other, perhaps with other holes: only points of the others, and of such holes, are asked for.
/// Both are in one frame, with the same doubles for the same points; neither is empty.
///
/// Triangles are halved as long as what is known of them allows more than the greatest distance
/// that a point has (Tang et al. 2009): the distance to a triangle is convex, so within another one
/// it is greatest at a corner.
double level_distance_m(const LevelSurface& a, const LevelSurface& b, double error_m = 0.005);
double level_distance_m(const Solid& a, const Solid& b, double error_m = 0.005);

}  // namespace oriel
