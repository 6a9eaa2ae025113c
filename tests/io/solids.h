#pragma once

#include "model/solid.h"

#include <vector>

namespace oriel::test {

/// Adds a closed box as a shell: facets bottom, top, south, east, north, west; its normals point
/// out of the material (into the box if it is a cavity).
inline void add_box(Solid& solid, Vec3 min, Vec3 max, int lump, bool is_cavity = false) {
  const int first = static_cast<int>(solid.vertices.size());
  for (const double z : {min.z, max.z})
    for (const Vec3 p : {Vec3{min.x, min.y, z}, Vec3{max.x, min.y, z}, Vec3{max.x, max.y, z},
                         Vec3{min.x, max.y, z}})
      solid.vertices.push_back({p, false});
  const std::vector<Loop> loops{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  const std::vector<Vec3> normals{{0, 0, -1}, {0, 0, 1}, {0, -1, 0},
                                  {1, 0, 0},  {0, 1, 0}, {-1, 0, 0}};
  Shell shell{{}, lump, is_cavity};
  for (std::size_t f = 0; f < loops.size(); ++f) {
    Loop loop = loops[f];
    for (int& v : loop) v += first;
    if (is_cavity) std::reverse(loop.begin(), loop.end());
    const Vec3 normal = is_cavity ? -normals[f] : normals[f];
    Plane plane;
    plane.normal = normal;
    plane.offset_m = dot(normal, solid.vertices[static_cast<std::size_t>(loop[0])].point);
    shell.facets.push_back({static_cast<int>(solid.facets.size())});
    solid.facets.push_back({PlaneId{static_cast<int>(solid.planes.size())}, {loop}, {}});
    solid.planes.push_back(plane);
  }
  solid.shells.push_back(shell);
}

}  // namespace oriel::test
