#pragma once

#include "model/building.h"

#include <span>
#include <string>
#include <vector>

namespace oriel::studio {

/// A building that is to stand in a picture with others.
struct Standee {
  std::string file;
  Box box_m;
  /// The origin of its own frame.
  Vec3 frame_m{};
  /// The coordinate reference system that its file names, by one name for each; or empty.
  std::string system{};
};

/// Where a building stands in the picture.
struct Standing {
  /// The place that is the origin of the picture for this building.
  Vec3 origin_m;
  /// How far it lies from most of the others, where that is too far for one picture; else 0.
  double away_m = 0;
  /// True if it lay upon others and stands beside them.
  bool is_moved = false;
};

/// The box of a building, where it really is.
Box box_of(const Building& building);

/// Gives where buildings stand: as they lie to each other, in the frame of where most are. Files
/// whose buildings lie upon those of other files stand beside the rest, side by side; a file whose
/// own buildings mostly lie upon each other has each of them beside the others. So stands what
/// names another reference system than most. What is far away stands out of sight.
std::vector<Standing> standings(std::span<const Standee> buildings);

}  // namespace oriel::studio
