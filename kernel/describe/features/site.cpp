#include "kernel/describe/features/site.h"

#include "kernel/geometry/directions.h"
#include "kernel/geometry/planar.h"

#include <algorithm>

namespace oriel::detail {

namespace {

/// Facets steeper than this are walls, not roofs or floors: halfway between a steep roof and a
/// leaning wall.
constexpr double kWallFrom_deg = 80;

Extent height_of(const Segmentation& segmentation, const Cell& cell) {
  Extent height;
  for (const Facet& facet : cell.facets)
    for (const Loop& loop : facet.loops)
      for (const int v : loop) {
        const double z = segmentation.vertices[static_cast<std::size_t>(v)].point.z;
        height.low = std::min(height.low, z);
        height.high = std::max(height.high, z);
      }
  return height;
}

}  // namespace

Site::Site(const Segmentation& segmentation)
    : segmentation_(segmentation), eaves_m_(segmentation.cells.size()) {
  double largest = 0;
  Extent all;
  find_uncut();
  for (std::size_t c = 0; c < segmentation.cells.size(); ++c) {
    const Cell& cell = segmentation.cells[c];
    if (cell.sign < 0) continue;
    const Extent height = height_of(segmentation, cell);
    all.low = std::min(all.low, height.low);
    if (cell.volume_m3 > largest || cell.flag == LeafFlag::open) {
      largest = cell.volume_m3;
      ridge_m_ = height.high;
    }
    for (int f = 0; f < std::ssize(cell.facets); ++f) {
      const Plane& plane =
          segmentation.planes[cell.facets[static_cast<std::size_t>(f)].plane.index()];
      const double inclination = inclination_deg(plane.normal);
      if (inclination > kWallFrom_deg && inclination < 180 - kWallFrom_deg) continue;
      if (is_uncut(cell.facets[static_cast<std::size_t>(f)])) continue;
      const CellId id{static_cast<int>(c)};
      GroundFacet found = ground_facet({id, f}, plane, id);
      if (inclination <= kWallFrom_deg)
        eaves_m_[c] = std::min(eaves_m_[c].value_or(found.box.min.z), found.box.min.z);
      else if (inclination >= 180 - kWallFrom_deg)
        grounds_.push_back(std::move(found));
    }
  }
  lowest_m_ = all.low;
  find_terrain();
}

/// What lies in uncut features is still there, and is neither ground nor roof.
void Site::find_uncut() {
  for (const Feature& feature : segmentation_.features)
    if (feature.is_uncut)
      uncut_.insert(feature.source_polygons.begin(), feature.source_polygons.end());
}

bool Site::is_uncut(const Facet& facet) const {
  return !uncut_.empty() && !facet.polygons.empty() &&
         std::ranges::all_of(facet.polygons, [&](int source) { return uncut_.contains(source); });
}

/// Air under the body that is open on three sides or more is where the ground rises under it: a
/// house on two levels. A passage or a recess has walls on two sides at least.
void Site::find_terrain() {
  std::vector<char> is_terrain(segmentation_.features.size(), 0);
  for (std::size_t i = 0; i < segmentation_.features.size(); ++i) {
    const Feature& f = segmentation_.features[i];
    if (f.sense != Sense::hole) continue;
    int open_sides = 0, below = 0;
    for (const PlaneId plane : f.planes) {
      const double inclination = inclination_deg(segmentation_.planes[plane.index()].normal);
      below += inclination >= 180 - kWallFrom_deg ? 1 : 0;
      open_sides += inclination > kWallFrom_deg && inclination < 180 - kWallFrom_deg ? 1 : 0;
    }
    is_terrain[i] = below == 1 && open_sides >= 3 ? 1 : 0;
  }
  for (std::size_t c = 0; c < segmentation_.cells.size(); ++c) {
    const Cell& cell = segmentation_.cells[c];
    if (cell.sign > 0 || !cell.feature.is_valid() || !is_terrain[cell.feature.index()]) continue;
    for (int f = 0; f < std::ssize(cell.facets); ++f) {
      const Plane& plane =
          segmentation_.planes[cell.facets[static_cast<std::size_t>(f)].plane.index()];
      // Outward from the void, up into the body.
      if (inclination_deg(plane.normal) <= kWallFrom_deg)
        terrain_.push_back(ground_facet({CellId{static_cast<int>(c)}, f}, plane, {}));
    }
  }
}

Site::GroundFacet Site::ground_facet(CellFacet facet, const Plane& plane, CellId cell) const {
  GroundFacet ground{facet_outlines(segmentation_, facet), {}, plane, cell};
  for (const Vec3& p : ground.outlines[0]) ground.box.grow(p);
  return ground;
}

std::optional<Foot> Site::lowest_at(Vec3 point, std::span<const GroundFacet> facets) {
  std::optional<Foot> lowest;
  for (const GroundFacet& facet : facets) {
    if (point.x < facet.box.min.x || point.x > facet.box.max.x || point.y < facet.box.min.y ||
        point.y > facet.box.max.y)
      continue;
    const Vec3 n = facet.plane.normal;
    const Vec3 on_facet{point.x, point.y,
                        (facet.plane.offset_m - n.x * point.x - n.y * point.y) / n.z};
    if (lowest && on_facet.z >= lowest->ground_m) continue;
    if (contains(facet.outlines, n, on_facet)) lowest = Foot{on_facet.z, "facet", facet.cell};
  }
  return lowest;
}

Foot Site::ground_at(Vec3 point, const std::optional<CellFacet>& wall) const {
  if (const auto risen = lowest_at(point, terrain_)) return *risen;
  if (const auto ground = lowest_at(point, grounds_)) return *ground;
  if (wall) {
    Extent height;
    for (const auto& outline : facet_outlines(segmentation_, *wall))
      height.low = std::min(height.low, extent_along(outline, {0, 0, 1}).low);
    return {height.low, "wall", wall->cell};
  }
  return {lowest_m_, "body", {}};
}

}  // namespace oriel::detail
