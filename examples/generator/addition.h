#pragma once

#include "examples/generator/geometry/point.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace oriel::generator {

/// A block, hole or panel that a house gets because somebody asked for it (`--add`), of a class
/// that may be new. Sizes and places are in whole millimetres.
struct Addition {
  /// A block stands out of its surface, on a roof upright; a panel is a slab parallel to it.
  enum class Shape { block, hole, panel };
  /// `wall` and `roof`: any of them, or the first where a position is given.
  enum class Surface { wall, front, back, left, right, gable, roof };

  std::string class_name;
  Shape shape = Shape::block;
  Surface surface = Surface::wall;
  /// Of the roof's planes or the gables, from 1; 0: any.
  int number = 0;
  /// Lower left corner, from the lower left corner of the surface as seen from outside; on a roof
  /// along the eaves and up the slope. Nothing: where there is room.
  std::optional<Uv> at;
  /// Along the surface, up it, and out of it or into it; 0 only of a hole: flush.
  Um width = 0, height = 0, depth = 0;
  /// As it was typed.
  std::string text;
};

/// What was asked for cannot be understood (E140) or has no room where it was to stand (E141). The
/// text begins with the code.
class AdditionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "CLASS block|hole|panel on SURFACE [at X,Y] size WxH[xD]", in metres (docs/generator.md). Throws
/// AdditionError E140, which says what was found and what may stand there.
Addition read_addition(std::string_view text);

}  // namespace oriel::generator
