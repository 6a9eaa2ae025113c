#include "examples/generator/output/truth.h"

#include "examples/generator/output/json.h"
#include "kernel/base/index.h"

namespace oriel::generator {
namespace {

/// An opening counts as detectable by shape from this recess on (the shared data's rule).
constexpr Um kDetectable = 2'000;

/// Faces, box and area of one object; the niche of an opening by itself.
struct Share {
  std::vector<int> faces, niche_faces;
  Extent box, box_with_niche;
  double area_m2 = 0;
};

std::vector<Share> shares_of(const Body& body) {
  std::vector<Share> shares(body.objects.size());
  for (std::size_t i = 0; i < body.polygons.size(); ++i) {
    const Polygon& polygon = body.polygons[i];
    Share& share = shares[at(polygon.owner.object)];
    for (const int vertex : polygon.rings[0]) {
      share.box_with_niche.grow(body.vertices[at(vertex)]);
      if (!polygon.owner.is_niche) share.box.grow(body.vertices[at(vertex)]);
    }
    (polygon.owner.is_niche ? share.niche_faces : share.faces).push_back(static_cast<int>(i));
    if (!polygon.owner.is_niche) share.area_m2 += length(doubled_area(body, polygon)) / 2;
  }
  return shares;
}

void append_name(Json& json, const Building& building, std::string_view key, int object) {
  if (object < 0)
    append_format(json, ",\"{}\":null", key);
  else
    append_format(json, ",\"{}\":\"{}_{}\"", key, building.id,
                  building.body.objects[at(object)].name);
}

void append_faces(Json& json, std::string_view key, const std::vector<int>& faces) {
  append_format(json, ",\"{}\":", key);
  append_list(json, faces, [&](int face) { append_number(json, face); });
}

void append_object(Json& json, const Building& building, const Object& object, const Share& share) {
  append_format(json, "{{\"id\":\"{}_{}\",\"class\":\"{}\",\"subclass\":\"{}\"", building.id,
                object.name, object.label(), object.subclass);
  append_name(json, building, "parent", object.parent);
  append_name(json, building, "host", object.host);
  append_text(json, ",\"aabb\":");
  append_metres(json, share.box.moved(building.origin));
  append_format(json, ",\"area\":{:.4f}", share.area_m2);
  append_faces(json, "faces", share.faces);
  if (object.recess) {
    append_text(json, ",\"recess_m\":");
    append_metres(json, *object.recess);
    append_text(json, ",\"feature_aabb\":");
    append_metres(json, share.box_with_niche.moved(building.origin));
    append_format(json, ",\"detectable\":{}", *object.recess >= kDetectable);
    append_faces(json, "niche_faces", share.niche_faces);
  }
  json.push_back('}');
}

std::size_t count_edges(const Body& body) {
  std::size_t half_edges = 0;
  for (const Polygon& polygon : body.polygons)
    for (const std::vector<int>& ring : polygon.rings) half_edges += ring.size();
  return half_edges / 2;
}

}  // namespace

std::string truth_json(const Building& building) {
  const Body& body = building.body;
  const std::vector<Share> shares = shares_of(body);
  Json json;
  append_format(json, "{{\"building\":\"{}\",\"dataset\":\"generated\",\"capped_faces\":[],",
                building.id);
  append_format(
      json,
      "\"shell\":{{\"shell\":\"closed-raw\",\"raw_faces\":{},\"edges\":{},\"volume\":{:.4f}}},",
      body.polygons.size(), count_edges(body), volume_m3(body));
  append_text(json, "\"objects\":");
  std::size_t i = 0;
  append_list(json, body.objects,
              [&](const Object& object) { append_object(json, building, object, shares[i++]); });
  append_text(json, "}\n");
  return fmt::to_string(json);
}

}  // namespace oriel::generator
