#include "kernel/describe/detail/surface_faces.h"

#include "kernel/describe/detail/shape.h"
#include "kernel/geometry/outlines.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace oriel::detail {

namespace {

/// cos 85 degrees. A window sill that slopes is far from it, a wall that leans near to it.
constexpr double kSteep = 0.0872;

Vec3 area_vector(const Outline& outline) {
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    sum = sum + cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
  return 0.5 * sum;
}

/// Corners of a polygon lie off its plane by millimetres: the plane goes through their mean.
Vec3 mean_of(const Outline& outline) {
  Vec3 sum;
  for (const Vec3 p : outline) sum = sum + p;
  return outline.empty() ? sum : (1.0 / static_cast<double>(outline.size())) * sum;
}

SurfaceFace face_of(std::vector<Outline> outlines) {
  SurfaceFace face;
  face.outlines = std::move(outlines);
  if (face.outlines.empty()) return face;
  for (const Vec3 p : face.outlines[0]) face.box.grow(p);
  const Vec3 outer = area_vector(face.outlines[0]);
  face.normal = normalised(outer);
  // Holes run the other way round; where they do not, they are holes all the same.
  face.area_m2 = length(outer);
  for (std::size_t i = 1; i < face.outlines.size(); ++i)
    face.area_m2 -= length(area_vector(face.outlines[i]));
  face.area_m2 = std::max(face.area_m2, 0.0);
  face.middle = mean_of(face.outlines[0]);
  if (face.normal == Vec3{}) return face;
  if (const auto inside = interior_point(face.outlines, face.normal)) {
    const double off = dot(face.middle - *inside, face.normal);
    face.middle = *inside + off * face.normal;
  }
  return face;
}

}  // namespace

bool SurfaceFace::is_steep() const { return std::abs(normal.z) < kSteep; }

double SurfaceFace::z_at(Vec3 point) const {
  const Vec3 d = point - middle;
  return middle.z - (d.x * normal.x + d.y * normal.y) / normal.z;
}

std::vector<SurfaceFace> faces_of(const Building& building) {
  std::vector<SurfaceFace> faces;
  faces.reserve(building.polygons.size());
  for (const Polygon& polygon : building.polygons) {
    std::vector<Outline> outlines;
    for (const auto& ring : polygon.rings) {
      outlines.emplace_back();
      for (const int v : ring)
        outlines.back().push_back(building.vertices[static_cast<std::size_t>(v)]);
    }
    faces.push_back(face_of(std::move(outlines)));
  }
  return faces;
}

std::vector<SurfaceFace> faces_of(const Solid& solid) {
  std::vector<SurfaceFace> faces;
  faces.reserve(solid.facets.size());
  for (const Facet& facet : solid.facets)
    faces.push_back(face_of(outlines_of(solid.vertices, facet.loops)));
  return faces;
}

Sides sides_of(const SurfaceFace& face) {
  if (face.normal == Vec3{}) return {};
  const Vec3 aside = std::abs(face.normal.z) < 0.5 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 u = normalised(cross(aside, face.normal)), v = cross(face.normal, u);
  std::vector<Vec3> flat;
  flat.reserve(face.outlines[0].size());
  for (const Vec3 p : face.outlines[0]) flat.push_back({dot(p, u), dot(p, v), 0});
  const StandingBox box = standing_box(flat);
  return {box.length, box.breadth};
}

}  // namespace oriel::detail
