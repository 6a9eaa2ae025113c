#pragma once

#include "kernel/base/index.h"
#include "kernel/base/work.h"
#include "kernel/solidify/crossings/faces.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

/// The points of a soup, to which more are added: none closer than `weld` to another one.
class GrowingPoints {
 public:
  GrowingPoints(std::vector<exact::GridPoint> points, double weld);

  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(points_[at(point)], 1); }
  /// The nearest point within `weld` of a place (grid units), or a new one there.
  int point_at(Vec3 place);
  [[nodiscard]] std::vector<exact::GridPoint> take() { return std::move(points_); }

 private:
  using GridCell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const GridCell& cell) const noexcept;
  };
  [[nodiscard]] GridCell cell_of(Vec3 place) const;
  void enter(int point);

  std::vector<exact::GridPoint> points_;
  double weld_;
  std::unordered_map<GridCell, boost::container::small_vector<int, 2>, Hash> cells_;
};

/// Of every polygon the edges on it along which others of its body run through it or lie on it, as
/// pairs of points: not yet cut where they meet.
std::vector<std::vector<PointPair>> find_chords(const Soup& soup,
                                                std::span<const PolygonShape> shapes, double reach,
                                                GrowingPoints& points, Work& work);

}  // namespace oriel::detail
