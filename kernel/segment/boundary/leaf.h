#pragma once

#include "kernel/model/solid.h"
#include "kernel/segment/planes/planes.h"

#include <vector>

namespace oriel::detail {

/// A convex body that is told to be a leaf before it is made: all that its cell is written from.
struct Leaf {
  struct Face {
    Side side;
    Loop loop;
  };
  std::vector<Face> faces;
  /// Facets of the solid that faces are made of, face by face.
  struct Source {
    int source, face;
  };
  std::vector<Source> sources;
  double volume = 0;
};

}  // namespace oriel::detail
