#pragma once

#include "examples/generator/house/house.h"

namespace oriel::generator {

/// How the roof of a part behind the house falls: from a ridge to both sides, to the side of its
/// x0, or away from the house.
enum class AdditionRoof { gable, to_x0, to_garden };

/// A part of the house before its back wall, from x0 to x1. Its roof ends below that wall's top.
struct BackAddition {
  Um x0 = 0, x1 = 0, length = 0;
  /// Height of the walls where the roof is lowest.
  Um eaves = 0;
  AdditionRoof roof = AdditionRoof::gable;
  Slope slope;

  /// How far the roof rises over the eaves.
  [[nodiscard]] Um rise() const;
};

/// The walls of an addition: towards smaller x, towards larger x, towards the garden.
struct AdditionWalls {
  Panel low_side, high_side, end;
};

/// Adds its roof planes to the house.
AdditionWalls add_back_addition(Draft& draft, House& house, const BackAddition& addition);

/// A flat-roofed garage beside the left wall of the house or, if `is_right`, the right one, from y0
/// to y1.
struct SideGarage {
  Um width = 0, y0 = 0, y1 = 0, height = 0;
  bool is_right = false;
};
/// Reserves its place on the wall; returns its front.
Panel add_side_garage(Draft& draft, House& house, const SideGarage& garage);

}  // namespace oriel::generator
