#include "model/building.h"

#include <cmath>
#include <utility>

namespace oriel {

Frame frame_of(const std::vector<Vec3>& points, std::string crs) {
  Box box;
  for (const Vec3 p : points) box.grow(p);
  if (box.is_empty()) box.grow(Vec3{});
  return {{std::floor(box.min.x), std::floor(box.min.y), std::floor(box.min.z)}, std::move(crs)};
}

Building without_installations(Building building) {
  if (building.installations.empty()) return building;
  const std::size_t own = building.installations.front().first_polygon;
  building.polygons.resize(own);
  std::erase_if(building.repeats, [&](const RepeatedVertex& repeat) {
    return static_cast<std::size_t>(repeat.polygon) >= own;
  });
  building.vertices.resize(building.installations.front().first_vertex);
  building.installations.clear();
  return building;
}

}  // namespace oriel
