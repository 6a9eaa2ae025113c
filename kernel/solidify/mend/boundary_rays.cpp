#include "kernel/solidify/mend/boundary_rays.h"

#include "kernel/geometry/planar.h"

#include <utility>
#include <vector>

namespace oriel::detail {

BoundaryRays::BoundaryRays(const Soup& soup, std::span<const PolygonShape> shapes,
                           const PolygonCells& cells, Work& work)
    : soup_(soup), shapes_(shapes), cells_(cells), work_(work), tree_({}) {
  std::vector<Box> boxes;
  Box all;
  for (int p = 0; p < soup.polygon_count(); ++p) {
    Box box;
    for (const int v : soup.corners_of(p)) box.grow(place(v));
    all.grow(box);
    if (!cells.is_boundary(p)) continue;
    polygons_.push_back(p);
    boxes.push_back(box);
  }
  reach_ = 2 * length(all.max - all.min);
  tree_ = BoxTree(std::move(boxes));
}

bool BoundaryRays::is_hit(int polygon, Vec3 eye) const {
  const Vec3 normal = shapes_[at(polygon)].unit;
  const double slope = dot(normal, kDirection);
  if (slope == 0) return false;
  const double way = dot(normal, place(soup_.corners_of(polygon).front()) - eye) / slope;
  if (way <= 0) return false;
  return contains(outlines_of(soup_, polygon), normal, eye + way * kDirection);
}

int BoundaryRays::depth_of(Vec3 eye) const {
  int depth = 0;
  for_each_hit(eye, [&](int polygon) {
    const bool runs_along = dot(shapes_[at(polygon)].unit, kDirection) > 0;
    depth += runs_along == cells_.is_front_outside(polygon) ? 1 : -1;  // it leaves, or comes in
  });
  return depth;
}

}  // namespace oriel::detail
