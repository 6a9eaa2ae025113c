#include "kernel/describe/surfaces/surface_faces.h"

#include "kernel/describe/features/shape.h"
#include "model/vec3.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace oriel::detail {

namespace {

/// cos 85 degrees. A window sill that slopes is far from it, a wall that leans near to it.
constexpr double kSteep = 0.0872;

SurfaceFace face_of(std::span<const OutlineView> outlines) {
  SurfaceFace face;
  face.outlines = outlines;
  if (outlines.empty()) return face;
  for (const Vec3& p : outlines[0]) face.box.grow(p);
  const Vec3 outer = area_vector(outlines[0]);
  face.normal = normalised(outer);
  // Holes run the other way round; where they do not, they are holes all the same.
  face.area_m2 = length(outer);
  for (std::size_t i = 1; i < outlines.size(); ++i)
    face.area_m2 -= length(area_vector(outlines[i]));
  face.area_m2 = std::max(face.area_m2, 0.0);
  return face;
}

}  // namespace

bool SurfaceFace::is_steep() const { return std::abs(normal.z) < kSteep; }

Vec3 SurfaceFace::mean() const {
  Vec3 sum;
  if (outlines.empty() || outlines[0].empty()) return sum;
  for (const Vec3& p : outlines[0]) sum = sum + p;
  return (1.0 / static_cast<double>(outlines[0].size())) * sum;
}

Vec3 SurfaceFace::middle() const {
  const Vec3 middle = mean();
  if (normal == Vec3{}) return middle;
  const auto inside = interior_point_of(outlines, normal);
  if (!inside) return middle;
  const double off = dot(middle - *inside, normal);
  return *inside + off * normal;
}

double z_at(const SurfaceFace& face, Vec3 on_plane, Vec3 point) {
  const Vec3 d = point - on_plane;
  return on_plane.z - (d.x * face.normal.x + d.y * face.normal.y) / face.normal.z;
}

template <class Figures, class RingsOf, class PointAt>
void SurfaceFaces::survey(const Figures& figures, RingsOf rings_of, PointAt point_at) {
  std::size_t points = 0, rings = 0;
  is_upright_.reserve(figures.size());
  for (const auto& figure : figures) {
    bool is_across_x = true, is_across_y = true;
    for (bool is_outer = true; const auto& ring : rings_of(figure)) {
      ++rings;
      points += ring.size();
      if (!std::exchange(is_outer, false) || ring.empty()) continue;
      const Vec3& first = point_at(ring.front());
      for (const int v : ring) {
        const Vec3& p = point_at(v);
        is_across_x &= p.x == first.x;
        is_across_y &= p.y == first.y;
        low_m_ = std::min(low_m_, p.z);
        high_m_ = std::max(high_m_, p.z);
      }
    }
    is_upright_.push_back(is_across_x || is_across_y ? 1 : 0);
  }
  points_.reserve(points);
  outlines_.reserve(rings);
  faces_.resize(figures.size());
  is_made_.resize(figures.size(), 0);
}

template <class Rings, class PointAt>
void SurfaceFaces::take(SurfaceFace& face, const Rings& rings, PointAt point_at) const {
  const std::size_t first = outlines_.size();
  for (const auto& ring : rings) {
    for (const int v : ring) points_.push_back(point_at(v));
    outlines_.push_back({points_.data() + points_.size() - ring.size(), ring.size()});
  }
  face = face_of(std::span(outlines_).subspan(first));
}

SurfaceFaces::SurfaceFaces(const Building& building) : building_(&building) {
  survey(
      building.polygons, [](const Polygon& p) -> const auto& { return p.rings; },
      [&](int v) -> const Vec3& { return building.vertices[static_cast<std::size_t>(v)]; });
}

SurfaceFaces::SurfaceFaces(const Solid& solid) : solid_(&solid) {
  survey(
      solid.facets, [](const Facet& f) -> const auto& { return f.loops; },
      [&](int v) -> const Vec3& { return solid.vertices[static_cast<std::size_t>(v)].point; });
}

void SurfaceFaces::make(std::size_t face) const {
  is_made_[face] = 1;
  if (building_ != nullptr)
    take(faces_[face], building_->polygons[face].rings,
         [&](int v) -> const Vec3& { return building_->vertices[static_cast<std::size_t>(v)]; });
  else
    take(faces_[face], solid_->facets[face].loops,
         [&](int v) -> const Vec3& { return solid_->vertices[static_cast<std::size_t>(v)].point; });
}

RectangleSides sides_of(const SurfaceFace& face) {
  if (face.normal == Vec3{}) return {};
  const Vec3 aside = std::abs(face.normal.z) < 0.5 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 u = normalised(cross(aside, face.normal)), v = cross(face.normal, u);
  std::vector<Vec3> flat;
  flat.reserve(face.outlines[0].size());
  for (const Vec3& p : face.outlines[0]) flat.push_back({dot(p, u), dot(p, v), 0});
  const StandingBox box = standing_box(flat);
  return {box.length, box.breadth};
}

}  // namespace oriel::detail
