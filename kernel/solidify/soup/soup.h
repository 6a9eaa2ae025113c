#pragma once

#include "kernel/base/issue.h"
#include "kernel/base/text/numbers.h"
#include "kernel/geometry/exact.h"
#include "model/building.h"
#include "model/tolerances.h"

#include <ranges>
#include <span>
#include <utility>
#include <vector>

namespace oriel {

/// The source of a face that no polygon of the input made.
inline constexpr int kNoSource = -1;

/// What the input says of a welded polygon.
struct SoupPolygon {
  int source = kNoSource;
  int body = 0;
  int shell = 0;
};

/// Two points of a soup, the smaller first.
using PointPair = std::pair<int, int>;

/// Welded polygons on the grid: points by coordinates, rings from their smallest vertex, polygons
/// in the order of the building, which is a CanonicalOrder where the input's must leave no trace.
///
/// The corners of all rings stand in one list, ring after ring, polygon after polygon. A ring is at
/// least a triangle and comes to no point twice.
struct Soup {
  double grid_m = 0;
  std::vector<exact::GridPoint> points;
  std::vector<SoupPolygon> polygons;
  /// Of every polygon its first ring, of every ring its first corner; one entry more at the end.
  Numbers first_ring{0};
  Numbers first_corner{0};
  /// Indices into `points`.
  Numbers corners;

  [[nodiscard]] int polygon_count() const { return static_cast<int>(polygons.size()); }
  [[nodiscard]] int ring_count() const { return static_cast<int>(first_corner.size()) - 1; }
  [[nodiscard]] int corner_count() const { return static_cast<int>(corners.size()); }

  /// The numbers of a polygon's rings.
  [[nodiscard]] auto rings_of(int polygon) const {
    const auto p = static_cast<std::size_t>(polygon);
    return std::views::iota(first_ring[p], first_ring[p + 1]);
  }
  [[nodiscard]] std::span<const int> ring(int ring) const {
    const auto r = static_cast<std::size_t>(ring);
    return {corners.data() + first_corner[r], corners.data() + first_corner[r + 1]};
  }
  [[nodiscard]] std::span<int> ring(int ring) {
    const auto r = static_cast<std::size_t>(ring);
    return {corners.data() + first_corner[r], corners.data() + first_corner[r + 1]};
  }
  /// Of all rings of a polygon.
  [[nodiscard]] std::span<const int> corners_of(int polygon) const {
    const auto p = static_cast<std::size_t>(polygon);
    return {corners.data() + first_corner[static_cast<std::size_t>(first_ring[p])],
            corners.data() + first_corner[static_cast<std::size_t>(first_ring[p + 1])]};
  }
};

/// The grid for a weld distance: the largest power of two ≤ weld_m / 1024, in metres.
double grid_for(double weld_m);

/// Rounds the vertices to the grid, unites those closer than weld_m, and drops what becomes
/// degenerate (E304). Needs coordinates in the exact range, and polygons that come by body.
Soup weld(const Building& building, const Tolerances& tolerances, std::vector<Issue>& issues);

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

/// A face that is put beside the polygons of the input.
struct AddedFace {
  std::vector<std::vector<int>> rings;
  int beside = -1;  ///< a polygon of its body
};

/// The soup with faces of no source, each behind the polygons of its body.
Soup with_faces(const Soup& soup, std::vector<AddedFace> faces);

}  // namespace oriel
