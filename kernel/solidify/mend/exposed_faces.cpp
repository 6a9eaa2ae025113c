#include "kernel/solidify/mend/exposed_faces.h"

#include "kernel/geometry/planar.h"
#include "kernel/solidify/mend/boundary_rays.h"

#include <vector>

namespace oriel::detail {

ExposedFaces find_exposed_faces(const Soup& soup, std::span<const PolygonShape> shapes,
                                const PolygonCells& cells, double reach, Work& work) {
  ExposedFaces exposed;
  double boundary = 0;
  Numbers inner;
  for (int p = 0; p < soup.polygon_count(); ++p) {
    if (soup.polygons[at(p)].source == kNoSource) continue;
    if (cells.is_boundary(p))
      boundary += shapes[at(p)].area;
    else if (!cells.is_front_outside(p))
      inner.push_back(p);
  }
  if (inner.empty()) return exposed;
  const BoundaryRays rays(soup, shapes, cells, work);
  for (const int p : inner) {
    work.add(std::ssize(soup.corners_of(p)));
    if (work.is_used_up()) return exposed;
    const Vec3 off = reach * shapes[at(p)].unit;
    const auto middle = interior_point(outlines_of(soup, p), shapes[at(p)].unit);
    if (!middle || rays.depth_of(*middle + off) > 0 || rays.depth_of(*middle - off) > 0) continue;
    ++exposed.polygons;
    exposed.area += shapes[at(p)].area;
  }
  exposed.share = exposed.polygons == 0 ? 0 : exposed.area / (exposed.area + boundary);
  return exposed;
}

}  // namespace oriel::detail
