#pragma once

#include "examples/generator/generate.h"
#include "model/building.h"
#include "tests/support/changed.h"

#include <utility>

namespace oriel::test {

/// A house of the generator as a building; polygons are numbered as in the body.
inline Building generated_building(const generator::Body& body) {
  Building building;
  building.id = "house";
  for (const generator::Point& p : body.vertices)
    building.vertices.push_back({static_cast<double>(p.x) / 1e6, static_cast<double>(p.y) / 1e6,
                                 static_cast<double>(p.z) / 1e6});
  for (const generator::Polygon& polygon : body.polygons) {
    Polygon copy;
    copy.rings = polygon.rings;
    copy.source = static_cast<int>(building.polygons.size());
    building.polygons.push_back(std::move(copy));
  }
  return framed(std::move(building));
}

}  // namespace oriel::test
