#pragma once

#include "examples/generator/house/house.h"

namespace oriel::generator {

/// A bay that stands on the ground before a wall, under a roof of its own that falls from the wall
/// to its front and sides.
struct BayWindow {
  /// On the wall; v1 is the eaves of its roof.
  Rect rect;
  Um depth = 0;
  /// Sides at 45°, else square.
  bool is_canted = true;
  /// How much higher the roof meets the wall; 0 = a flat roof.
  Um rise = 0;
};

/// The bay's faces, as seen from outside, each with u = 0 at its left end. On the sides of a canted
/// bay a step of u or w is `stretch` long.
struct BayFaces {
  Panel left, front, right;
  double stretch = 1;
};

BayFaces add_bay_window(Draft& draft, Panel& panel, const BayWindow& bay);

}  // namespace oriel::generator
