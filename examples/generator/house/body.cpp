#include "examples/generator/house/body.h"

#include <array>

namespace oriel::generator {
namespace {

constexpr std::array<std::string_view, kClasses> kNames{
    "window", "door",   "chimney", "vent",  "dormer", "balcony", "loggia",
    "bay",    "canopy", "stairs",  "other", "wall",   "roof",    "other"};

}  // namespace

std::string_view name_of(Class kind) { return kNames[static_cast<std::size_t>(kind)]; }

std::optional<Class> class_named(std::string_view name) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(Class::wall); ++i)
    if (kNames[i] == name) return static_cast<Class>(i);
  return std::nullopt;
}

std::string_view Object::label() const { return given_class.empty() ? name_of(kind) : given_class; }

Extent extent_of(const std::vector<Point>& points) {
  Extent extent;
  for (const Point& p : points) extent.grow(p);
  return extent;
}

Vec3 doubled_area(const Body& body, const std::vector<int>& ring) {
  Vec3 sum;
  const auto at = [&](std::size_t i) { return body.vertices[static_cast<std::size_t>(ring[i])]; };
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum = sum + cross(metres(at(i) - at(0)), metres(at(i + 1) - at(0)));
  return sum;
}

Vec3 doubled_area(const Body& body, const Polygon& polygon) {
  Vec3 sum;
  for (const std::vector<int>& ring : polygon.rings) sum = sum + doubled_area(body, ring);
  return sum;
}

double volume_m3(const Body& body) {
  double sum = 0;
  const Point origin = body.vertices[0];
  for (const Polygon& polygon : body.polygons) {
    const Point first = body.vertices[static_cast<std::size_t>(polygon.rings[0][0])];
    sum += dot(metres(first - origin), doubled_area(body, polygon));
  }
  return sum / 6;
}

}  // namespace oriel::generator
