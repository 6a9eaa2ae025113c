#include "kernel/validate/solids/triangle_pairs.h"

#include <algorithm>
#include <cstddef>

namespace oriel::detail {

namespace {

/// `corners` turned so that those shared with `other` come first; how many there are.
std::size_t shared_first(TriangleCorners& corners, const TriangleCorners& other) {
  const auto is_shared = [&](int corner) {
    return std::ranges::find(other, corner) != other.end();
  };
  const auto rest = std::ranges::stable_partition(corners, is_shared);
  return static_cast<std::size_t>(rest.begin() - corners.begin());
}

}  // namespace

MicrometreTriangle points_of(const SnappedBuilding& building, const TriangleCorners& corners) {
  return {building.point(corners[0]), building.point(corners[1]), building.point(corners[2])};
}

bool fold_back(const SnappedBuilding& building, const TriangleCorners& a, int p, int q) {
  const MicrometreTriangle triangle = points_of(building, a);
  if (side_of(triangle[0], triangle[1], triangle[2], building.point(q)) != 0) return false;
  const std::size_t axis = main_axis(triangle);
  const auto flat = [&](int v) { return flattened(building.point(v), axis, true); };
  return turn(flat(a[0]), flat(a[1]), flat(p)) == turn(flat(a[0]), flat(a[1]), flat(q));
}

bool intersect(const SnappedBuilding& building, TriangleCorners a, TriangleCorners b) {
  const std::size_t shared = shared_first(a, b);
  shared_first(b, a);
  if (shared == 3) return true;
  if (shared == 2) return fold_back(building, a, a[2], b[2]);
  const MicrometreTriangle one = points_of(building, a);
  const MicrometreTriangle other = points_of(building, b);
  if (shared == 0) return meet(one, other);
  // Beyond the common corner one of the opposite edges would have to touch the other triangle.
  return meets(one[1], one[2], other) || meets(other[1], other[2], one);
}

}  // namespace oriel::detail
