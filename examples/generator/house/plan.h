#pragma once

#include "examples/generator/options.h"
#include "examples/generator/random.h"

namespace oriel::generator {

/// The windows of one house: alike but for jitter.
struct WindowStyle {
  Um width = 0, height = 0;
  /// Of the window's bottom over the floor.
  Um sill_height = 0;
  Um recess = 0;
  /// Panes side by side and one above the other.
  int columns = 1, rows = 1;
};

/// Everything about a house that is drawn before it is built.
struct Plan {
  Massing massing;
  int storeys = 1;
  Um storey_height = 0;
  /// Height of the ground floor; a multiple of the steps' rise.
  Um base = 0;
  int steps = 0;
  /// About the width of a column of windows.
  Um column_width = 0;
  WindowStyle window;
  /// What this house has.
  FeatureSet features;
  /// Share of the places for windows that get one.
  double density = 0.92;
  double flush = 0;
  Um jitter = 0;
  std::optional<ChimneyPlace> chimney;
  /// Height of the band at the foot of the walls; 0 = none.
  Um plinth = 0;

  [[nodiscard]] bool has(Feature feature) const { return features.has(feature); }
  /// Height of storey i's floor.
  [[nodiscard]] Um floor(int i) const { return base + i * storey_height; }
};

Plan draw_plan(const Options& options, Random& random);

}  // namespace oriel::generator
