#pragma once

#include "kernel/geometry/planar.h"
#include "model/building.h"
#include "model/vec3.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// An upright polygon of a building, in the building's frame.
struct UprightWall {
  std::vector<Outline> outlines;  ///< the outer one first
  Vec3 normal;                    ///< out of the building, as its corners say
  Box box;
};

/// A roof with a ridge that falls to two sides, as far as blocks know it.
struct GabledRoof {
  Vec3 ridge;  ///< level, of length 1, either way
  /// The means of the highest and of the lowest points of what falls to the sides, by area, z in
  /// the building's frame.
  double ridge_m = 0, eaves_m = 0;
};

/// What others see of a building: its outlines, in its frame.
struct StandingShape {
  std::vector<UprightWall> walls;
  /// The ground that it covers, seen from above: polygons within half a metre of its lowest point
  /// that are not steep, or all that are not steep if these cover less than half of what the others
  /// do. z = 0, outer outlines counter-clockwise. Pieces may lie on each other in the latter case.
  std::vector<std::vector<Outline>> ground;
};

/// What is known of a building at any time, its outlines apart.
struct StandingBuilding {
  std::string id;
  int system = -1;  ///< a number for Frame::crs, the same for those that have the same
  Vec3 origin_m;    ///< Frame::origin_m
  Box box;          ///< in the frame
  double ground_m2 = 0;
  double ground_m = 0;  ///< z of its lowest point
  /// The mean height of what is seen of its roofs from above, by area, z in the frame.
  double roof_m = 0;
  /// Where four fifths of the roof, seen from above, fall to two opposite sides to 10 degrees, and
  /// a fifth at least to each.
  std::optional<GabledRoof> gable{};
};

/// One of them with its outlines, which are there as long as this is.
struct ShapedBuilding {
  const StandingBuilding& known;
  std::shared_ptr<const StandingShape> shape;
};

/// What is kept of a building so that others know that it stands there; its `system` is not set.
/// Walls below a twentieth of a square metre and polygons without area are left out, and so are
/// those of up to four square metres that look at ground of the building itself, such as the sides
/// and the pane of a window: nothing can stand against them.
std::pair<StandingBuilding, StandingShape> standing_building(const Building& building);

/// Ground in another frame, in which its own lies at `moved_m`; z = 0.
std::vector<std::vector<Outline>> moved_ground(const StandingShape& shape, Vec3 moved_m);

}  // namespace oriel
