#pragma once

#include "model/building.h"
#include "model/labelled_building.h"
#include "model/vec3.h"

#include <string>
#include <vector>

namespace oriel {

/// A window or a door as it is written: the rectangle that it takes up in its wall or roof.
struct WrittenOpening {
  std::string type;     ///< Window, Door
  Vec3 normal;          ///< of the wall or roof, out of the building; of a wall level
  double offset_m = 0;  ///< of what stands furthest out along it
  bool is_in_wall = false;
  /// Along the wall, seen from outside, and upwards; of a roof in any axes of its plane.
  double left_m = 0, right_m = 0, bottom_m = 0, top_m = 0;

  [[nodiscard]] double width_m() const { return right_m - left_m; }
  [[nodiscard]] double height_m() const { return top_m - bottom_m; }
  [[nodiscard]] double area_m2() const { return width_m() * height_m(); }
};

/// The semantic surfaces Window and Door of a building that is to be written, in their order; those
/// without polygons are left out. Their plane is that of the largest polygon of their `parent`, or
/// of their own.
std::vector<WrittenOpening> written_openings(const Building& building,
                                             const LabelledBuilding& labelled);

/// How openings stand to each other on their facades (docs/generalisation.md#quality).
struct FacadeQuality {
  int openings = 0;
  double openings_m2 = 0;
  /// Rows of two or more.
  int rows = 0;
  /// Rows whose sills, or whose lintels, are level within kAligned_m.
  int aligned_rows = 0;
  /// Rows of three or more, and those of them whose gaps are equal within kAligned_m.
  int long_rows = 0;
  int even_rows = 0;
  /// The share of the openings' area in walls that lies on the mirror image of openings of the same
  /// type, about the middle of those of the facade; 1 where there are none.
  double symmetry = 1;
};

/// What is no further apart looks level: 0.02 mm on a map at 1:1000.
inline constexpr double kAligned_m = 0.02;

/// Source of what is looked at: Shen, Fan, Mao and Wang 2016, "Typification for Façade Structures
/// Based on User Perception" (alignment, distribution and shape); the numbers are our own.
FacadeQuality facade_quality(const std::vector<WrittenOpening>& openings);

/// A length that is as it should be may be less by what rounding takes: corners are put on a grid
/// of a thousandth of a millimetre, and where planes meet at small angles they move by some hundred
/// times that.
inline constexpr double kRoundedOff_m = 1e-4;

/// The gaps between openings of one facade that stand beside each other or one above the other: the
/// smallest, and how many are below `least_m`.
struct OpeningGaps {
  double smallest_m = Box::kInfinity;
  int narrow = 0;
};
OpeningGaps opening_gaps(const std::vector<WrittenOpening>& openings, double least_m);

}  // namespace oriel
