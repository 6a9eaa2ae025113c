#pragma once

#include "kernel/geometry/planar.h"
#include "model/building.h"

#include <unordered_map>
#include <vector>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

/// An input polygon in space.
struct PlacedPolygon {
  int source = -1;
  boost::container::small_vector<Outline, 1> rings;  ///< the outer one first
  Box box;
  Vec3 area;  ///< its area vector, in m²

  [[nodiscard]] const Outline& outline() const { return rings[0]; }
  [[nodiscard]] Vec3 middle() const { return 0.5 * (box.min + box.max); }
};

/// The input polygons of a building, found by the middles of their boxes.
class PolygonGrid {
 public:
  /// Of no polygons.
  PolygonGrid() = default;
  /// `grid_m` as for outlines_of.
  PolygonGrid(const Building& building, double grid_m);

  [[nodiscard]] const std::vector<PlacedPolygon>& polygons() const { return polygons_; }

  /// The polygon with a source number that there is.
  [[nodiscard]] const PlacedPolygon& of(int source) const;

  /// Indices of the polygons whose middle is in the box, by source.
  [[nodiscard]] std::vector<int> within(const Box& box) const;

 private:
  struct GridPlace {
    long x, y, z;
    friend bool operator==(const GridPlace&, const GridPlace&) = default;
  };
  struct Hash {
    std::size_t operator()(const GridPlace& p) const;
  };
  static GridPlace place_of(Vec3 point);

  std::vector<PlacedPolygon> polygons_;
  using PolygonsOfCell = boost::container::small_vector<int, 4>;  ///< polygons
  std::unordered_map<GridPlace, PolygonsOfCell, Hash> cells_;
};

}  // namespace oriel::detail
