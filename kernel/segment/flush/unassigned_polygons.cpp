#include "kernel/segment/flush/unassigned_polygons.h"

#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "model/vec3.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <vector>

namespace oriel::detail {

namespace {

/// A pane may hang a little askew, and stand as far from its opening as an old wall is thick.
constexpr double kAskew_deg = 5;
constexpr double kThickWall_m = 0.5;

struct UnassignedPolygon {
  int source = -1;
  std::vector<Outline> rings;
  Vec3 normal;
  double area_m2 = 0;
};

Vec3 area_vector(const std::vector<Outline>& rings) {
  Vec3 doubled;
  for (const Outline& ring : rings)
    add_doubled_area(doubled, ring.size(), [&](std::size_t i) { return ring[i]; });
  return 0.5 * doubled;
}

class Joiner {
 public:
  Joiner(const Building& building, const Solid& solid, Segmentation& segmentation,
         const Tolerances& tolerances, Work& work)
      : building_(building),
        solid_(solid),
        out_(segmentation),
        tolerances_(tolerances),
        work_(work) {}

  void run() {
    for (const UnassignedPolygon& polygon : unassigned_polygons())
      if (!work_.is_used_up() && !join(polygon)) lay(polygon);
  }

 private:
  /// The largest first, so that what lies within another comes behind it.
  [[nodiscard]] std::vector<UnassignedPolygon> unassigned_polygons() const {
    int count = 0;
    for (const Polygon& polygon : building_.polygons) count = std::max(count, polygon.source + 1);
    std::vector<char> has_facet(at(count), 0);
    for (const Facet& facet : solid_.facets)
      for (const int source : facet.polygons) has_facet[at(source)] = 1;
    std::vector<UnassignedPolygon> loose;
    for (const Polygon& polygon : building_.polygons) {
      if (polygon.source < 0 || has_facet[at(polygon.source)] || polygon.rings[0].empty()) continue;
      UnassignedPolygon found{
          polygon.source, outlines_of(building_, polygon, solid_.grid_m), {}, 0};
      double round_m = 0;
      for (const Outline& ring : found.rings) round_m += perimeter(ring);
      const Vec3 area = area_vector(found.rings);
      found.area_m2 = length(area);
      found.normal = normalised(area);
      if (found.area_m2 > tolerances_.weld_m * round_m / 2) loose.push_back(std::move(found));
    }
    std::ranges::sort(loose, {}, [](const UnassignedPolygon& p) {
      const Vec3 first = p.rings[0][0];
      return std::tuple(-p.area_m2, first.x, first.y, first.z, p.source);
    });
    return loose;
  }

  [[nodiscard]] static bool is_parallel(Vec3 p, Vec3 q, double tolerance_deg) {
    return length(cross(p, q)) <= std::sin(tolerance_deg * std::numbers::pi / 180);
  }

  /// True if there is an opening that the polygon belongs to.
  bool join(const UnassignedPolygon& polygon) {
    std::optional<std::pair<double, FeatureId>> smallest;
    work_.add(std::ssize(out_.features));
    for (const FeatureId i : ids_below<FeatureId>(out_.features.size())) {
      const Feature& f = out_.features[i.index()];
      if (f.sense != Sense::hole && f.sense != Sense::imprint) continue;
      const Vec3 normal = out_.planes[f.planes.front().index()].normal;
      if (!is_parallel(polygon.normal, normal, kAskew_deg)) continue;
      const auto covered = covered_m2(polygon, f, normal);
      if (covered && (!smallest || std::pair(*covered, i) < *smallest)) smallest = {*covered, i};
    }
    if (!smallest) return false;
    add_to(smallest->second, polygon);
    return true;
  }

  /// The size of the opening's rectangle if the polygon covers it as it must.
  [[nodiscard]] std::optional<double> covered_m2(const UnassignedPolygon& polygon, const Feature& f,
                                                 Vec3 normal) const {
    std::vector<Vec3> points;
    work_.add(std::ssize(f.vertices));
    for (const int v : f.vertices) points.push_back(out_.vertices[at(v)].point);
    const ReachAxes axes = axes_in(normal);
    const Reach opening = axes.reach_of(points), pane = axes.reach_of(polygon.rings[0]);
    const Reach common = opening.common(pane);
    if (common.is_empty() || common.area() < pane.area() / 2) return std::nullopt;
    const auto [near, far] = depths(points, normal);
    const auto [pane_near, pane_far] = depths(polygon.rings[0], normal);
    if (std::max(pane_near - far, near - pane_far) > kThickWall_m) return std::nullopt;
    return opening.area();
  }

  [[nodiscard]] static std::pair<double, double> depths(const std::vector<Vec3>& points,
                                                        Vec3 normal) {
    double low = Box::kInfinity, high = -Box::kInfinity;
    for (const Vec3 p : points) {
      low = std::min(low, dot(p, normal));
      high = std::max(high, dot(p, normal));
    }
    return {low, high};
  }

  /// Adds the polygon to a feature, and to all that this one lies in.
  void add_to(FeatureId id, const UnassignedPolygon& polygon) {
    const int first = static_cast<int>(out_.vertices.size());
    for (const Vec3 p : polygon.rings[0]) out_.vertices.push_back({p, false});
    std::vector<FeatureId> around{id};
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (!around[i].is_valid()) continue;
      Feature& f = out_.features[around[i].index()];
      const auto place = std::ranges::lower_bound(f.source_polygons, polygon.source);
      if (place != f.source_polygons.end() && *place == polygon.source) continue;
      f.source_polygons.insert(place, polygon.source);
      f.surface_m2 += polygon.area_m2;
      for (int v = first; v < std::ssize(out_.vertices); ++v) {
        f.vertices.push_back(v);
        f.box.grow(out_.vertices[at(v)].point);
      }
      around.push_back(f.parent);
      around.push_back(f.host);
    }
  }

  /// Makes the polygon an imprint of the facet in which it lies.
  void lay(const UnassignedPolygon& polygon) {
    for (const CellId c : ids_below<CellId>(out_.cells.size())) {
      const Cell& cell = out_.cells[c.index()];
      work_.add(std::ssize(cell.facets));
      for (int f = 0; f < std::ssize(cell.facets); ++f) {
        const Facet& facet = cell.facets[at(f)];
        // Facets that only cuts made are no surface.
        if (facet.polygons.empty()) continue;
        const Plane& plane = out_.planes[facet.plane.index()];
        if (!lies_in(polygon, facet, plane)) continue;
        add_imprint(polygon, {c, f}, plane);
        return;
      }
    }
  }

  [[nodiscard]] bool lies_in(const UnassignedPolygon& polygon, const Facet& facet,
                             const Plane& plane) const {
    if (!is_parallel(polygon.normal, plane.normal, tolerances_.coplanar_deg)) return false;
    const auto is_off = [&](Vec3 p) {
      return std::abs(dot(p, plane.normal) - plane.offset_m) > tolerances_.plane_offset_m;
    };
    if (std::ranges::any_of(polygon.rings[0], is_off)) return false;
    const auto outlines = outlines_of(out_.vertices, facet.loops);
    const auto middle = interior_point(polygon.rings, polygon.normal);
    return middle && contains(outlines, plane.normal, *middle);
  }

  void add_imprint(const UnassignedPolygon& polygon, CellFacet home, const Plane& cell_plane) {
    const Cell& cell = out_.cells[home.cell.index()];
    Feature f;
    f.sense = Sense::imprint;
    f.parent = cell.feature;
    f.host = cell.feature;
    f.host_facet = home;
    f.planes = {plane_of(cell, cell_plane, home)};
    f.is_natural = true;
    f.new_area_m2 = f.surface_m2 = polygon.area_m2;
    const Plane& plane = out_.planes[f.planes[0].index()];
    Outline outline = polygon.rings[0];
    for (Vec3& p : outline) p = p + (plane.offset_m - dot(p, plane.normal)) * plane.normal;
    if (signed_area(outline, plane.normal) < 0) std::ranges::reverse(outline);
    f.cap_point = interior_point({{outline}}, plane.normal).value_or(outline[0]);
    for (const Vec3 p : outline) {
      f.outline.push_back(static_cast<int>(out_.vertices.size()));
      out_.vertices.push_back({p, false});
      f.box.grow(p);
    }
    f.vertices = f.outline;
    f.source_polygons = {polygon.source};
    out_.features.push_back(std::move(f));
  }

  /// The plane that looks out of the building: facets of voids look into it.
  [[nodiscard]] PlaneId plane_of(const Cell& cell, const Plane& plane, CellFacet home) const {
    const PlaneId own = cell.facets[at(home.facet)].plane;
    if (cell.sign > 0) return own;
    for (const PlaneId p : ids_below<PlaneId>(out_.planes.size())) {
      const Plane& other = out_.planes[p.index()];
      if (other.offset == -plane.offset && other.coefficients[0] == -plane.coefficients[0] &&
          other.coefficients[1] == -plane.coefficients[1] &&
          other.coefficients[2] == -plane.coefficients[2])
        return p;
    }
    return own;
  }

  const Building& building_;
  const Solid& solid_;
  Segmentation& out_;
  const Tolerances& tolerances_;
  Work& work_;
};

}  // namespace

void join_unassigned_polygons(const Building& building, const Solid& solid,
                              Segmentation& segmentation, const Tolerances& tolerances,
                              Work& work) {
  Joiner(building, solid, segmentation, tolerances, work).run();
}

}  // namespace oriel::detail
