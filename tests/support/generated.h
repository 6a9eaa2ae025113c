#pragma once

#include "examples/generator/generate.h"
#include "model/building.h"

#include <utility>
#include <vector>

namespace oriel::test {

/// A house of the generator and the boxes of what it knows to be there, those in the input's
/// coordinates.
struct Generated {
  Building building;
  std::vector<std::pair<generator::Class, Box>> objects;
};

inline Generated generated(const generator::Options& options, int index) {
  const generator::Body body = generator::generate(options, index);
  Generated out;
  out.building.id = "house-" + std::to_string(index);
  for (const generator::Point p : body.vertices) out.building.vertices.push_back(metres(p));
  out.building.frame = frame_of(out.building.vertices, "");
  for (const generator::Object& object : body.objects) out.objects.emplace_back(object.kind, Box{});
  for (const generator::Polygon& polygon : body.polygons) {
    Box& box = out.objects[static_cast<std::size_t>(polygon.owner.object)].second;
    for (const int vertex : polygon.rings[0])
      box.grow(out.building.vertices[static_cast<std::size_t>(vertex)]);
    Polygon copy;
    copy.rings = polygon.rings;
    copy.source = static_cast<int>(out.building.polygons.size());
    out.building.polygons.push_back(std::move(copy));
  }
  for (Vec3& vertex : out.building.vertices) vertex = vertex - out.building.frame.origin_m;
  return out;
}

}  // namespace oriel::test
