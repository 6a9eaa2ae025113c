#pragma once

#include "kernel/model/solid.h"
#include "kernel/segment/planes/planes.h"

#include <vector>

namespace oriel::detail {

/// A convex body that is told to be a leaf before it is made: all that its cell is written from.
struct PocketLeaf {
  struct LeafFace {
    PlaneSide side;
    Loop loop;
  };
  std::vector<LeafFace> faces;
  /// Facets of the solid that faces are made of, face by face.
  struct LeafSource {
    int source, face;
  };
  std::vector<LeafSource> sources;
  double volume = 0;
};

}  // namespace oriel::detail
