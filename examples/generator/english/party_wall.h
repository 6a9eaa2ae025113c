#pragma once

#include "examples/generator/house/rooftop.h"

#include <optional>

namespace oriel::generator {

/// A chimney stack on a roof, with courses that stick out below its top and pots in a grid on it.
struct Stack {
  /// Seen from above.
  Rect plan;
  /// Height of the brickwork's top, absolute.
  Um top = 0;
  int columns = 1, rows = 1;
  /// Height of the pots; 0 leaves open flues.
  Um pot = 0;
};

/// The stack's faces towards smaller and larger y.
struct StackFaces {
  FacetId front{}, back{};
};
StackFaces add_stack(Draft& draft, House& house, const Stack& stack);

/// A party wall that rises over the two planes of a roof whose ridge runs along x, from x0 to x1.
/// It starts at the foot of plane 0 and ends at that of plane 1; a stack may stand in it.
struct Upstand {
  Um x0 = 0, x1 = 0, height = 0;
  /// The stack's extent along y, and its faces.
  Um stack_y0 = 0, stack_y1 = 0;
  std::optional<StackFaces> stack;
  /// The gable walls that the upstand continues, where it stands at the end of the row; and the
  /// inner face of a parapet that it runs against, at least as high.
  FacetId west = kNewFacet, east = kNewFacet, front = kNewFacet;
};
/// Decor: the vocabulary has no word for it.
void add_upstand(Draft& draft, House& house, const Upstand& upstand);

}  // namespace oriel::generator
