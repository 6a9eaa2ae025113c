#include "io/objects/ground_areas.h"

#include "io/files/input.h"
#include "io/json/json_check.h"
#include "io/json/text.h"
#include "kernel/base/issue.h"
#include "kernel/geometry/directions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel {

namespace {

constexpr std::array<std::string_view, 7> kTypes{
    "Road", "Railway", "TransportSquare", "Waterway", "WaterBody", "LandUse", "PlantCover"};
/// Of a line that does not say how wide it is.
constexpr double kThinnest_m = 0.1;

double doubled_area_m2(const std::vector<Vec3>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 p = ring[i] - ring[0], q = ring[(i + 1) % ring.size()] - ring[0];
    sum += p.x * q.y - p.y * q.x;
  }
  return sum;
}

/// Gathers the areas; what is wrong is a std::runtime_error.
class AreaReader {
 public:
  void read_geojson(const nlohmann::json& root) {
    const std::string type = root.at("type").get<std::string>();
    if (type == "FeatureCollection") {
      const nlohmann::json& features = root.at("features");
      for (std::size_t i = 0; i < features.size(); ++i)
        within(fmt::format("feature {}", i + 1), [&] { read_feature(features[i]); });
    } else if (type == "Feature") {
      read_feature(root);
    } else {
      read_geometry(root, kThinnest_m);
    }
  }

  void read_cityjson(const nlohmann::json& root) {
    scale_ = {1, 1, 1};
    if (const auto transform = root.find("transform"); transform != root.end()) {
      scale_ = point_of(transform->at("scale"));
      translate_ = point_of(transform->at("translate"));
    }
    const nlohmann::json& vertices = root.at("vertices");
    for (const auto& [id, object] : root.at("CityObjects").items()) {
      const std::string type = object.at("type").get<std::string>();
      if (std::ranges::find(kTypes, type) == kTypes.end() || !object.contains("geometry")) continue;
      within("the object '" + id + "'", [&] {
        for (const nlohmann::json& geometry : object.at("geometry"))
          if (geometry.contains("boundaries")) read_nested(geometry.at("boundaries"), vertices);
      });
    }
  }

  [[nodiscard]] std::vector<GroundArea> take() { return std::move(areas_); }

 private:
  template <class Act>
  static void within(const std::string& where, Act act) {
    try {
      act();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& fault) {
      throw std::runtime_error(where + ": " + fault.what());
    }
  }

  static Vec3 point_of(const nlohmann::json& numbers) {
    if (!numbers.is_array() || numbers.size() < 2)
      throw std::runtime_error("a position is not two or three numbers");
    const Vec3 p{numbers[0].get<double>(), numbers[1].get<double>(),
                 numbers.size() > 2 ? numbers[2].get<double>() : 0};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw std::runtime_error("a coordinate is no number");
    return p;
  }

  static std::vector<Vec3> points_of(const nlohmann::json& positions) {
    if (!positions.is_array())
      throw std::runtime_error("its coordinates are not nested as its type asks");
    std::vector<Vec3> points;
    for (const nlohmann::json& position : positions) points.push_back(point_of(position));
    return points;
  }

  void read_feature(const nlohmann::json& feature) {
    const nlohmann::json& geometry = feature.at("geometry");
    if (geometry.is_null()) return;
    double width_m = kThinnest_m;
    if (const auto properties = feature.find("properties");
        properties != feature.end() && properties->is_object() && properties->contains("width"))
      width_m = properties->at("width").get<double>();
    if (!(width_m > 0)) throw std::runtime_error("its 'width' is not above 0");
    read_geometry(geometry, width_m);
  }

  void read_geometry(const nlohmann::json& geometry, double width_m) {
    const std::string type = geometry.at("type").get<std::string>();
    if (type == "GeometryCollection") {
      for (const nlohmann::json& one : geometry.at("geometries")) read_geometry(one, width_m);
      return;
    }
    if (type == "Point" || type == "MultiPoint") return;
    const nlohmann::json& coordinates = geometry.at("coordinates");
    if (type == "Polygon") {
      add_polygon(coordinates);
    } else if (type == "MultiPolygon") {
      for (const nlohmann::json& polygon : coordinates) add_polygon(polygon);
    } else if (type == "LineString") {
      add_line(points_of(coordinates), width_m);
    } else if (type == "MultiLineString") {
      for (const nlohmann::json& line : coordinates) add_line(points_of(line), width_m);
    } else {
      throw std::runtime_error("its geometry has the unknown type '" + type + "'");
    }
  }

  void add_polygon(const nlohmann::json& rings) {
    GroundArea area;
    for (const nlohmann::json& ring : rings) area.push_back(points_of(ring));
    add(std::move(area));
  }

  /// A rectangle for each piece, half as wide longer than it at both ends.
  void add_line(const std::vector<Vec3>& line, double width_m) {
    if (line.size() < 2) throw std::runtime_error("a line has fewer than two points");
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Vec3 from{line[i].x, line[i].y, 0}, to{line[i + 1].x, line[i + 1].y, 0};
      if (!(length(to - from) > 0)) continue;
      const Vec3 along = (width_m / 2 / length(to - from)) * (to - from);
      const Vec3 aside{-along.y, along.x, 0};
      add({{from - along - aside, to + along - aside, to + along + aside, from - along + aside}});
    }
  }

  /// Polygons of a CityJSON geometry, however deep they are nested.
  void read_nested(const nlohmann::json& boundaries, const nlohmann::json& vertices) {
    const bool is_polygon = boundaries.is_array() && !boundaries.empty() &&
                            boundaries[0].is_array() && !boundaries[0].empty() &&
                            boundaries[0][0].is_number();
    if (!is_polygon) {
      for (const nlohmann::json& part : boundaries)
        if (part.is_array()) read_nested(part, vertices);
      return;
    }
    GroundArea area;
    for (const nlohmann::json& ring : boundaries) {
      std::vector<Vec3>& points = area.emplace_back();
      for (const nlohmann::json& number : ring) {
        const Vec3 p = point_of(vertices.at(number.get<std::size_t>()));
        points.push_back({translate_.x + scale_.x * p.x, translate_.y + scale_.y * p.y,
                          translate_.z + scale_.z * p.z});
      }
    }
    // What is as steep as a wall lies over no ground.
    if (area[0].size() < 3 || looks_aside(normalised(area_vector(area[0])))) return;
    add(std::move(area));
  }

  void add(GroundArea area) {
    for (std::size_t i = 0; i < area.size(); ++i) {
      std::vector<Vec3>& ring = area[i];
      for (Vec3& p : ring) p.z = 0;
      if (ring.size() > 1 && length(ring.front() - ring.back()) == 0) ring.pop_back();
      if (ring.size() < 3) throw std::runtime_error("a ring has fewer than three points");
      if ((doubled_area_m2(ring) > 0) != (i == 0)) std::ranges::reverse(ring);
    }
    if (!area.empty()) areas_.push_back(std::move(area));
  }

  std::vector<GroundArea> areas_;
  Vec3 scale_, translate_;
};

[[noreturn]] void refuse_ground(const std::string& file, std::string sentence) {
  throw InputError(error_in({file, 0}, {Code::E190, std::move(sentence)}));
}

}  // namespace

std::vector<GroundArea> read_ground_areas(const std::string& file) {
  const std::string text = Input(file).read_all();
  std::vector<Issue> issues;
  const auto root = parse_slowly({file, 0}, without_bom(text), issues);
  if (!root) throw InputError(issues.front());
  AreaReader reader;
  try {
    if (root->at("type") == "CityJSON")
      reader.read_cityjson(*root);
    else
      reader.read_geojson(*root);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& fault) {
    refuse_ground(file, fmt::format("is no GeoJSON and no CityJSON with ground to be kept free: {}",
                                    fault.what()));
  }
  auto areas = reader.take();
  if (areas.empty()) refuse_ground(file, "has no area to be kept free");
  return areas;
}

}  // namespace oriel
