#pragma once

#include "examples/generator/house/house.h"

namespace oriel::generator {

/// A balcony: a slab, and on it a parapet around a hollow.
struct Balcony {
  /// On the panel, from the slab's bottom to the parapet's top.
  Rect rect;
  Um depth = 0;
  Um slab = 0;
  /// Thickness of the parapet; 0 leaves a bare slab, rect ends at its top.
  Um parapet = 0;
  /// How far screens on both sides rise over the parapet; 0 = none.
  Um screens = 0;
};
int add_balcony(Draft& draft, Panel& panel, const Balcony& balcony);

/// A loggia: a room open to the front, with a parapet of the given height in the opening (0 =
/// none). Returns the panel that is its back wall; v there is still the height over ground.
Panel add_loggia(Draft& draft, Panel& panel, const Rect& rect, Um depth, Um parapet);

/// A bay: a box before the panel, from the ground if the rectangle starts there. Either its top
/// falls towards the front by `fall`, or its front is narrower than its back by `splay` on both
/// sides.
struct Bay {
  Rect rect;
  Um depth = 0, fall = 0, splay = 0;
};
/// Returns the panel that is the bay's front.
Panel add_bay(Draft& draft, Panel& panel, const Bay& bay);

/// A canopy: a slab out of the panel, its underside level, its top sloped down by `fall`.
int add_canopy(Draft& draft, Panel& panel, const Rect& rect, Um depth, Um fall);

/// Steps from the ground up to `rect.v1` in front of the panel: a landing, then treads.
int add_stairs(Draft& draft, Panel& panel, const Rect& rect, int steps, Um landing, Um tread);

/// A block before the panel that is none of the classes.
int add_decor(Draft& draft, Panel& panel, std::string_view subclass, const Rect& rect, Um depth);

}  // namespace oriel::generator
