#pragma once

#include "examples/generator/house/house.h"

#include <string>

namespace oriel::generator {

/// A window or a door in a panel.
struct Opening {
  Class kind = Class::window;
  /// "Window", "Door" or a finer kind.
  std::string subclass;
  Rect rect;
  /// How far the pane or leaf lies behind the panel; 0 = flush.
  Um recess = 0;
  /// Columns and rows of panes in the frame; 1 × 1 has no frame. Each pane of several lies
  /// kPaneDepth behind the frame.
  int columns = 1, rows = 1;
};

inline constexpr Um kPaneDepth = 40'000;
/// Width of the frame around and between several panes.
inline constexpr Um kFrameWidth = 80'000;

/// Cuts the opening into the panel and reserves its place there. Where it reaches down to the
/// panel's ground, the ground is notched. Returns its object.
int add_opening(Draft& draft, Panel& panel, const Opening& opening);

/// A window in a roof plane, its rectangle seen from above; `drop` is how far it lies below the
/// roof, measured straight down. Returns its object.
int add_roof_window(Draft& draft, RoofPlane& plane, const Rect& rect, Um drop);

}  // namespace oriel::generator
