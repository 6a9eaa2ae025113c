#pragma once

#include "model/building.h"
#include "tests/fuzz/support/byte_source.h"

namespace oriel::fuzz {

/// How exactly the result for a body is known to be the same when the body is told differently.
struct Body {
  Building building;
  /// Nothing was changed on the body: a valid solid whose planes are far from each other or the
  /// same.
  bool is_valid = true;
};

/// A valid body: boxes on a grid of quarter metres, the bodies of tests/support/houses.h, a prism
/// over a corner or a star, a house of the generator, a box with a cavity and what stands in it.
/// Coordinates are whole multiples of kUnit_m, so that turning by right angles and moving by whole
/// metres are exact.
Body valid_body(ByteSource& bytes);

/// The same changed as long as there are bytes, at most a dozen times (mutations.h).
Body changed_body(ByteSource& bytes);

inline constexpr double kUnit_m = 1.0 / 1024;

/// Every coordinate at the nearest multiple of kUnit_m.
void put_on_grid(Building& building);

/// Polygon::source and the frame as a reader would make them.
Building as_read(Building building);

}  // namespace oriel::fuzz
