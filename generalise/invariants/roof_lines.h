#pragma once

#include "kernel/model/solid.h"

#include <optional>
#include <vector>

namespace oriel {

/// A level edge.
struct LevelLine {
  double height_m = 0;  ///< z in the frame
  double length_m = 0;
};

/// The level edges at which the facets of a roof begin and end: facets of no more than 75 degrees,
/// the default pack's steepest roof.
struct RoofLines {
  /// Between a facet that rises from there, or is level, and what is no roof: a wall, a verge.
  std::vector<LevelLine> eaves;
  /// Between facets of which one falls off from there and the other is a roof that falls off, too,
  /// or no roof.
  std::vector<LevelLine> ridges;
};

RoofLines roof_lines(const Solid& solid);

/// The height at which most of the length lies, to the centimetre; of equal ones the highest.
/// Nothing if there are no lines.
std::optional<double> main_height_m(const std::vector<LevelLine>& lines);

/// The length of lines no more than `within_m` above or below a height.
double length_near_m(const std::vector<LevelLine>& lines, double height_m, double within_m);

}  // namespace oriel
