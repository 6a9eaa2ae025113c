#include "examples/generator/output/cityjson.h"

#include "examples/generator/output/json.h"
#include "examples/generator/output/semantics.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace oriel::generator {
namespace {

void append_boundaries(Json& json, const Body& body, const std::vector<int>& polygons) {
  append_list(json, polygons, [&](int polygon) {
    append_list(json, body.polygons[at(polygon)].rings, [&](const std::vector<int>& ring) {
      append_list(json, ring, [&](int vertex) { append_number(json, vertex); });
    });
  });
}

void append_geometry(Json& json, const Building& building, const std::vector<int>& polygons,
                     Content content, bool is_solid) {
  append_format(json, "\"geometry\":[{{\"type\":\"{}\",\"lod\":\"3\",\"boundaries\":",
                is_solid ? "Solid" : "MultiSurface");
  if (is_solid) json.push_back('[');
  append_boundaries(json, building.body, polygons);
  if (is_solid) json.push_back(']');
  if (content == Content::labelled) {
    append_text(json, ",\"semantics\":");
    append_semantics(json, building, polygons, is_solid);
  }
  append_text(json, "}]");
}

void append_installation(Json& json, const Building& building, int number,
                         const std::vector<int>& polygons) {
  const Object& object = building.body.objects[at(number)];
  append_format(json, ",\"{0}_{1}\":{{\"type\":\"BuildingInstallation\",\"parents\":[\"{0}\"],",
                building.id, object.name);
  append_format(json, "\"attributes\":{{\"class\":\"1000\",\"function\":\"{}\",",
                function_code(object.kind));
  append_format(json,
                "\"oriel_codelist\":\"sig3d\",\"oriel_label\":\"{}\",\"oriel_subclass\":\"{}\",",
                object.label(), object.subclass);
  append_text(json, "\"oriel_geometry\":\"shared\"},");
  append_geometry(json, building, polygons, Content::labelled, false);
  json.push_back('}');
}

void append_building(Json& json, const Building& building, Content content) {
  const Body& body = building.body;
  std::vector<int> all(body.polygons.size());
  std::iota(all.begin(), all.end(), 0);
  append_format(json, "\"{}\":{{\"type\":\"Building\",", building.id);
  std::vector<int> installations;
  if (content == Content::labelled) {
    append_format(
        json, "\"attributes\":{{\"roofType\":\"{}\",\"storeysAboveGround\":{},\"measuredHeight\":",
        body.roof, body.storeys);
    const Extent extent = extent_of(body.vertices);
    append_metres(json, extent.high.z - extent.low.z);
    append_text(json, "},");
    for (std::size_t i = 0; i < body.objects.size(); ++i)
      if (!is_surface(body.objects[i].kind) && !is_opening(body.objects[i].kind))
        installations.push_back(static_cast<int>(i));
  }
  if (!installations.empty()) {
    append_text(json, "\"children\":");
    append_list(json, installations, [&](int object) {
      append_format(json, "\"{}_{}\"", building.id, body.objects[at(object)].name);
    });
    json.push_back(',');
  }
  append_geometry(json, building, all, content, true);
  json.push_back('}');
  const std::vector<std::vector<int>> polygons = polygons_by_object(body);
  for (const int object : installations)
    append_installation(json, building, object, polygons[at(object)]);
}

void append_vertices(Json& json, const Body& body) {
  append_text(json, "\"vertices\":");
  append_list(json, body.vertices, [&](Point p) {
    json.push_back('[');
    append_number(json, p.x);
    json.push_back(',');
    append_number(json, p.y);
    json.push_back(',');
    append_number(json, p.z);
    json.push_back(']');
  });
}

void append_head(Json& json, Point origin) {
  append_text(json,
              "{\"type\":\"CityJSON\",\"version\":\"2.0\",\"transform\":{\"scale\":"
              "[0.000001,0.000001,0.000001],\"translate\":");
  append_metres(json, origin);
  json.push_back('}');
}

}  // namespace

std::string_view function_code(Class kind) {
  switch (kind) {
    case Class::balcony:
      return "1000";
    case Class::chimney:
      return "1030";
    case Class::stairs:
      return "1060";
    default:
      return "1070";
  }
}

std::vector<std::vector<int>> polygons_by_object(const Body& body) {
  std::vector<std::vector<int>> polygons(body.objects.size());
  for (std::size_t i = 0; i < body.polygons.size(); ++i)
    for (int object = body.polygons[i].owner.object; object >= 0;
         object = body.objects[at(object)].parent)
      polygons[at(object)].push_back(static_cast<int>(i));
  return polygons;
}

Body shuffled(const Body& body, Random& random) {
  Body result = body;
  std::vector<int> order(body.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  random.shuffle(order);
  for (std::size_t i = 0; i < order.size(); ++i) result.vertices[at(order[i])] = body.vertices[i];
  random.shuffle(result.polygons);
  for (Polygon& polygon : result.polygons)
    for (std::vector<int>& ring : polygon.rings) {
      for (int& vertex : ring) vertex = order[at(vertex)];
      const int start = random.below(static_cast<int>(ring.size()));
      std::rotate(ring.begin(), ring.begin() + start, ring.end());
    }
  return result;
}

std::string cityjson(const Building& building, Content content) {
  Json json;
  append_head(json, building.origin);
  append_text(json, ",\"metadata\":{\"geographicalExtent\":");
  append_metres(json, extent_of(building.body.vertices).moved(building.origin));
  append_text(json, "},\"CityObjects\":{");
  append_building(json, building, content);
  append_text(json, "},");
  append_vertices(json, building.body);
  append_text(json, "}\n");
  return fmt::to_string(json);
}

std::string cityjson_header(Point origin) {
  Json json;
  append_head(json, origin);
  append_text(json, ",\"CityObjects\":{},\"vertices\":[]}\n");
  return fmt::to_string(json);
}

std::string cityjson_feature(const Building& building, Content content) {
  Json json;
  append_format(json, "{{\"type\":\"CityJSONFeature\",\"id\":\"{}\",\"CityObjects\":{{",
                building.id);
  append_building(json, building, content);
  append_text(json, "},");
  append_vertices(json, building.body);
  append_text(json, "}\n");
  return fmt::to_string(json);
}

}  // namespace oriel::generator
