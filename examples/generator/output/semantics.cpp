#include "examples/generator/output/semantics.h"

#include "kernel/base/index.h"

#include <array>

namespace oriel::generator {
namespace {

enum class Surface { wall, roof, ground, floor, ceiling, window, door };
constexpr std::array<std::string_view, 7> kTypeNames{
    "WallSurface",         "RoofSurface", "GroundSurface", "OuterFloorSurface",
    "OuterCeilingSurface", "Window",      "Door"};

/// The semantic type of a polygon. Faces of installations go by their normal.
Surface surface_of(const Body& body, const Polygon& polygon) {
  const Class kind = body.objects[at(polygon.owner.object)].kind;
  switch (kind) {
    case Class::window:
      return Surface::window;
    case Class::door:
      return Surface::door;
    case Class::wall:
      return Surface::wall;
    case Class::roof:
      return Surface::roof;
    case Class::ground:
      return Surface::ground;
    default:
      break;
  }
  const double z = normalised(doubled_area(body, polygon)).z;
  if (z < -0.5) return Surface::ceiling;
  if (z < 0.3) return Surface::wall;
  const bool is_walked_on =
      kind == Class::balcony || kind == Class::loggia || kind == Class::stairs;
  return is_walked_on ? Surface::floor : Surface::roof;
}

/// Numbers the surfaces of one body: one per object and type.
class Numbering {
 public:
  explicit Numbering(const Body& body) : body_(body), index_of_(body.objects.size()) {
    for (auto& indices : index_of_) indices.fill(-1);
  }

  Surfaces of(const std::vector<int>& polygons) {
    for (const int polygon : polygons)
      result_.of_polygon.push_back(index(body_.polygons[at(polygon)]));
    for (std::size_t i = 0; i < result_.surfaces.size(); ++i) {
      const int parent = result_.surfaces[i].parent = parent_of(result_.surfaces[i]);
      if (parent >= 0) result_.surfaces[at(parent)].children.push_back(static_cast<int>(i));
    }
    return std::move(result_);
  }

 private:
  int index(const Polygon& polygon) {
    const auto type = static_cast<std::size_t>(surface_of(body_, polygon));
    int& found = index_of_[at(polygon.owner.object)][type];
    if (found < 0) {
      found = static_cast<int>(result_.surfaces.size());
      result_.surfaces.push_back({polygon.owner.object, kTypeNames[type], -1, {}});
    }
    return found;
  }
  [[nodiscard]] int parent_of(const SemanticSurface& surface) const {
    const Object& object = body_.objects[at(surface.object)];
    if (!is_opening(object.kind)) return -1;
    const bool is_in_roof = body_.objects[at(object.host)].kind == Class::roof;
    const Surface type = is_in_roof ? Surface::roof : Surface::wall;
    return index_of_[at(object.host)][static_cast<std::size_t>(type)];
  }

  const Body& body_;
  std::vector<std::array<int, kTypeNames.size()>> index_of_;
  Surfaces result_;
};

void append_surface(Json& json, const Building& building, const Surfaces& all, std::size_t i) {
  const SemanticSurface& surface = all.surfaces[i];
  const Object& object = building.body.objects[at(surface.object)];
  append_format(json, "{{\"type\":\"{}\",\"oriel_id\":\"{}_{}\",\"oriel_label\":\"{}\"",
                surface.type, building.id, object.name, object.label());
  append_format(json, ",\"oriel_subclass\":\"{}\"", object.subclass);
  if (surface.parent >= 0) append_format(json, ",\"parent\":{}", surface.parent);
  if (!surface.children.empty()) {
    append_text(json, ",\"children\":");
    append_list(json, surface.children, [&](int child) { append_number(json, child); });
  }
  json.push_back('}');
}

}  // namespace

Surfaces surfaces_of(const Body& body, const std::vector<int>& polygons) {
  return Numbering(body).of(polygons);
}

void append_semantics(Json& json, const Building& building, const std::vector<int>& polygons,
                      bool is_solid) {
  const Surfaces all = surfaces_of(building.body, polygons);
  append_text(json, "{\"surfaces\":");
  std::size_t i = 0;
  append_list(json, all.surfaces,
              [&](const SemanticSurface&) { append_surface(json, building, all, i++); });
  append_text(json, is_solid ? ",\"values\":[" : ",\"values\":");
  append_list(json, all.of_polygon, [&](int value) { append_number(json, value); });
  append_text(json, is_solid ? "]}" : "}");
}

}  // namespace oriel::generator
