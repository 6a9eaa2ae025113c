#pragma once

#include "tests/support/shapes.h"

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

namespace oriel::test {

/// A box of whole metres.
struct GridBox {
  std::array<int, 3> min, max;
  bool is_added = true;
};

/// A part that a cut splits off, without its place.
struct ReferenceFeature {
  bool is_hole = false;
  int order = 0;  ///< planes of the cut; 0: a cavity
  std::int64_t new_area = 0, old_area = 0, volume = 0;
  friend auto operator<=>(const ReferenceFeature&, const ReferenceFeature&) = default;
};

struct Reference {
  int leaves = 0, inner = 0;
  std::vector<ReferenceFeature> features;  ///< sorted
  /// Somewhere on the way a body touched itself along an edge, where it is a matter of convention
  /// what hangs together.
  bool is_degenerate = false;
};

/// The paper's order (section 4) for a body of boxes, slow and simple: the body is a set of cells
/// of the grid that all boxes span; lumps are sets of cells that hang together over faces, areas
/// and volumes whole numbers, and every set of up to four oriented planes is tried. Shares no code
/// with the kernel.
Reference reference_of(const std::vector<GridBox>& boxes);

}  // namespace oriel::test
