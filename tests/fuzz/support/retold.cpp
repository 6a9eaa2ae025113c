#include "tests/fuzz/support/retold.h"

#include "kernel/mesh/triangulate.h"
#include "tests/support/changed.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::fuzz {

namespace {

using Polygons = std::vector<const Polygon*>;

std::string text_of(const Polygon& polygon) {
  std::string text;
  for (const std::vector<int>& ring : polygon.rings)
    text += fmt::format("{}[{}]", text.empty() ? "" : ",", fmt::join(ring, ","));
  return "[" + text + "]";
}

std::string list_of(const Polygons& polygons) {
  std::string text;
  for (const Polygon* polygon : polygons) text += (text.empty() ? "" : ",") + text_of(*polygon);
  return "[" + text + "]";
}

/// In shells, if the numbers of shells say so; of a number that no polygon has an empty one.
std::string shells_of(const Polygons& body) {
  std::string text;
  int last = 0;
  for (const Polygon* polygon : body) last = std::max(last, polygon->shell);
  for (int shell = 0; shell <= last; ++shell) {
    Polygons some;
    for (const Polygon* polygon : body)
      if (polygon->shell == shell) some.push_back(polygon);
    text += (shell == 0 ? "" : ",") + list_of(some);
  }
  return "[" + text + "]";
}

std::string boundaries_of(const Building& building, std::string& type) {
  Polygons all;
  for (const Polygon& polygon : building.polygons) all.push_back(&polygon);
  int last = 0;
  for (const Polygon& polygon : building.polygons) last = std::max(last, polygon.body);
  if (!building.is_solid) return list_of(all);
  type = last == 0 ? "Solid" : "MultiSolid";
  if (last == 0) return shells_of(all);
  std::string text;
  for (int body = 0; body <= last; ++body) {
    Polygons some;
    for (const Polygon* polygon : all)
      if (polygon->body == body) some.push_back(polygon);
    text += (body == 0 ? "" : ",") + shells_of(some);
  }
  return "[" + text + "]";
}

}  // namespace

Building turned_by_right_angle(Building building) {
  building.frame = {};
  return test::framed(test::mapped(std::move(building), [](Vec3 p) {
    return Vec3{-p.y, p.x, p.z};
  }));
}

Building moved_by_metres(Building building) {
  const Vec3 by{690000, 5334000, 480};
  building.frame = {};
  return test::framed(test::mapped(std::move(building), [by](Vec3 p) { return p + by; }));
}

Building cut_into_triangles(const Building& building) {
  Building out = building;
  out.polygons.clear();
  for (const Polygon& polygon : building.polygons) {
    const std::vector<int>& outer = polygon.rings[0];
    Vec3 doubled;
    add_doubled_area(doubled, outer.size(), [&](std::size_t i) {
      return building.vertices[static_cast<std::size_t>(outer[i])];
    });
    for (const auto& corners : triangulate(building.vertices, polygon.rings, normalised(doubled))) {
      Polygon triangle = polygon;
      triangle.rings = {{corners.begin(), corners.end()}};
      triangle.source = static_cast<int>(out.polygons.size());
      out.polygons.push_back(std::move(triangle));
    }
  }
  return out;
}

std::string cityjson_of(const Building& building, double scale_m) {
  std::string type = "MultiSurface";
  const std::string boundaries = boundaries_of(building, type);
  std::string vertices;
  const auto whole = [&](double value) {
    return static_cast<std::int64_t>(std::llround(value / scale_m));
  };
  for (const Vec3 p : building.vertices)
    vertices += fmt::format("{}[{},{},{}]", vertices.empty() ? "" : ",", whole(p.x), whole(p.y),
                            whole(p.z));
  return fmt::format(
      R"({{"type":"CityJSON","version":"2.0","transform":{{"scale":[{0},{0},{0}],)"
      R"("translate":[690000,5334000,480]}},"CityObjects":{{"a":{{"type":"Building","geometry":[)"
      R"({{"type":"{1}","lod":"3","boundaries":{2}}}]}}}},"vertices":[{3}]}})",
      scale_m, type, boundaries, vertices);
}

}  // namespace oriel::fuzz
