#include "interpret/surfaces/polygon_shape.h"

#include "kernel/geometry/directions.h"
#include "model/vec3.h"

namespace oriel::rules {

namespace {

Vec3 vertex(const Building& building, int index) {
  return building.vertices[static_cast<std::size_t>(index)];
}

}  // namespace

Vec3 area_vector(const Building& building, const Polygon& polygon) {
  if (polygon.rings.empty()) return {};
  return oriel::area_vector(building.vertices, polygon.rings[0]);
}

double inclination_deg(Vec3 direction) {
  return direction == Vec3{} ? 90 : oriel::inclination_deg(direction);
}

Box box_of(const Building& building, const Polygon& polygon) {
  Box box;
  if (polygon.rings.empty()) return box;
  for (const int index : polygon.rings[0]) box.grow(vertex(building, index));
  return box;
}

}  // namespace oriel::rules
