#include "kernel/describe/detail/site.h"

#include "kernel/geometry/planar.h"

#include <algorithm>

namespace oriel::detail {

namespace {

/// Facets steeper than this are walls, not roofs or floors: halfway between a steep roof and a
/// leaning wall.
constexpr double kWallFrom_deg = 80;

}  // namespace

Site::Site(const Segmentation& segmentation)
    : segmentation_(segmentation), eaves_m_(segmentation.cells.size()) {
  double largest = 0;
  Extent all;
  for (std::size_t c = 0; c < segmentation.cells.size(); ++c) {
    const Cell& cell = segmentation.cells[c];
    if (cell.sign < 0) continue;
    const Extent height = extent_along(points_of(segmentation, cell), {0, 0, 1});
    all.low = std::min(all.low, height.low);
    if (cell.volume_m3 > largest) {
      largest = cell.volume_m3;
      ridge_m_ = height.high;
    }
    for (int f = 0; f < std::ssize(cell.facets); ++f) {
      const Plane& plane =
          segmentation.planes[cell.facets[static_cast<std::size_t>(f)].plane.index()];
      const double inclination = inclination_deg(plane.normal);
      if (inclination > kWallFrom_deg && inclination < 180 - kWallFrom_deg) continue;
      const auto outlines = outlines_of(segmentation, {CellId{static_cast<int>(c)}, f});
      Box box;
      for (const Vec3 p : outlines[0]) box.grow(p);
      if (inclination <= kWallFrom_deg)
        eaves_m_[c] = std::min(eaves_m_[c].value_or(box.min.z), box.min.z);
      else if (inclination >= 180 - kWallFrom_deg)
        grounds_.push_back({outlines, box, plane, CellId{static_cast<int>(c)}});
    }
  }
  lowest_m_ = all.low;
}

Foot Site::ground_at(Vec3 point, const std::optional<CellFacet>& wall) const {
  std::optional<double> lowest;
  CellId cell;
  for (const GroundFacet& facet : grounds_) {
    if (point.x < facet.box.min.x || point.x > facet.box.max.x || point.y < facet.box.min.y ||
        point.y > facet.box.max.y)
      continue;
    const Vec3 n = facet.plane.normal;
    const Vec3 on_facet{point.x, point.y,
                        (facet.plane.offset_m - n.x * point.x - n.y * point.y) / n.z};
    if (lowest && on_facet.z >= *lowest) continue;
    if (!contains(facet.outlines, n, on_facet)) continue;
    lowest = on_facet.z;
    cell = facet.cell;
  }
  if (lowest) return {*lowest, "facet", cell};
  if (wall) {
    Extent height;
    for (const auto& outline : outlines_of(segmentation_, *wall))
      height.low = std::min(height.low, extent_along(outline, {0, 0, 1}).low);
    return {height.low, "wall", wall->cell};
  }
  return {lowest_m_, "body", {}};
}

}  // namespace oriel::detail
