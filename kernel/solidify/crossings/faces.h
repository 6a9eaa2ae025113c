#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <span>
#include <utility>
#include <vector>

namespace oriel::detail {

/// Areas that differ by less than this part are the same: points lie beside the plane.
inline constexpr double kSameArea = 1e-3;

/// A polygon of a soup and what cuts it.
struct CutPolygon {
  int polygon = -1;
  /// The outer ring, then the holes; they may have more points than in the soup.
  std::vector<std::vector<int>> rings;
  /// Edges on the polygon, none of them one of the rings', that meet each other and the rings in
  /// common points only.
  std::vector<PointPair> edges;
};

/// A ring of a polygon as points of the soup.
std::vector<std::vector<int>> rings_of(const Soup& soup, int polygon);

using Loops = std::vector<std::vector<int>>;

/// What half-edges in a plane part it into. They must meet in common points only.
struct Faces {
  /// Walks them, turning as far to the left as there is a way.
  Faces(const Soup& soup, Vec3 normal, std::span<const PointPair> half_edges);

  /// The outer loop of a face and those of its holes.
  [[nodiscard]] std::vector<std::size_t> rings_of(std::size_t face) const;

  Loops loops;                    ///< of three points or more
  std::vector<Outline> outlines;  ///< their places in grid units
  std::vector<double> areas;      ///< positive of the outer loop of a face, grid units squared
  /// For every loop that runs clockwise the smallest face that it is a hole of, -1 for the others.
  std::vector<int> face_of;

 private:
  void find_faces_around(Vec3 normal);
};

/// Adds the faces into which the edges part a polygon to the builder, or the polygon as its rings
/// say where there is one face only, or where the faces' area differs from the polygon's by more
/// than `slack` (grid units squared): then edges cross. True if it was parted. Edges that lead into
/// a face and part nothing of it are left out. The builder is like `soup`.
bool add_faces(const Soup& soup, const PolygonShape& shape, const CutPolygon& cut, double slack,
               SoupBuilder& builder);

}  // namespace oriel::detail
