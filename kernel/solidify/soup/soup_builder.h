#pragma once

#include "kernel/solidify/soup/soup.h"

#include <span>

namespace oriel::detail {

/// Makes a soup polygon by polygon. Polygons must come by body.
class SoupBuilder {
 public:
  /// An empty soup with the points of `like`.
  explicit SoupBuilder(const Soup& like);

  void begin_polygon(const SoupPolygon& said);
  /// Adds to the polygon that was begun what is left of a ring: runs there and back go, it is cut
  /// where it comes to a point again, and every piece starts at its smallest point.
  void add_ring(std::span<const int> ring);
  /// Adds a polygon of the soup that the builder is like as it is, or turned round.
  void add_polygon(const Soup& from, int polygon, bool is_turned = false);

  /// The soup; polygons that got no ring are left out.
  Soup finish();

 private:
  void close_polygon();
  void append(std::span<const int> simple_ring);

  Soup soup_;
  bool is_begun_ = false;
  Numbers path_, place_;  ///< of the ring being cut; place_ by point, -1 off the path
};

}  // namespace oriel::detail
