#include "examples/generator/semantics.h"

#include <array>

namespace oriel::generator {
namespace {

enum class Surface { wall, roof, ground, floor, ceiling, window, door };
constexpr std::array<std::string_view, 7> kSurfaceNames{
    "WallSurface",         "RoofSurface", "GroundSurface", "OuterFloorSurface",
    "OuterCeilingSurface", "Window",      "Door"};

std::size_t at(int index) { return static_cast<std::size_t>(index); }

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

/// The semantic surfaces of some polygons: one per object and type, openings below the surface they
/// are cut into.
class Semantics {
 public:
  Semantics(const Building& building, const std::vector<int>& polygons)
      : building_(building), index_of_(building.body.objects.size()) {
    for (auto& indices : index_of_) indices.fill(-1);
    for (const int polygon : polygons)
      values_.push_back(index(building.body.polygons[at(polygon)]));
    children_.resize(surfaces_.size());
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
      if (const int parent = parent_of(i); parent >= 0)
        children_[at(parent)].push_back(static_cast<int>(i));
  }

  void append_to(Json& json, bool is_solid) const {
    append_text(json, "{\"surfaces\":");
    std::size_t i = 0;
    append_list(json, surfaces_, [&](const Entry&) { append_surface(json, i++); });
    append_text(json, is_solid ? ",\"values\":[" : ",\"values\":");
    append_list(json, values_, [&](int value) { append_number(json, value); });
    append_text(json, is_solid ? "]}" : "}");
  }

 private:
  struct Entry {
    int object;
    Surface type;
  };

  int index(const Polygon& polygon) {
    const Surface type = surface_of(building_.body, polygon);
    int& found = index_of_[at(polygon.owner.object)][static_cast<std::size_t>(type)];
    if (found < 0) {
      found = static_cast<int>(surfaces_.size());
      surfaces_.push_back({polygon.owner.object, type});
    }
    return found;
  }
  [[nodiscard]] int parent_of(std::size_t surface) const {
    const Object& object = building_.body.objects[at(surfaces_[surface].object)];
    if (!is_opening(object.kind)) return -1;
    const bool is_in_roof = building_.body.objects[at(object.host)].kind == Class::roof;
    const Surface type = is_in_roof ? Surface::roof : Surface::wall;
    return index_of_[at(object.host)][static_cast<std::size_t>(type)];
  }
  void append_surface(Json& json, std::size_t i) const {
    const Object& object = building_.body.objects[at(surfaces_[i].object)];
    append_format(json, "{{\"type\":\"{}\",\"oriel_id\":\"{}_{}\",\"oriel_label\":\"{}\"",
                  kSurfaceNames[static_cast<std::size_t>(surfaces_[i].type)], building_.id,
                  object.name, name_of(object.kind));
    append_format(json, ",\"oriel_subclass\":\"{}\"", object.subclass);
    if (const int parent = parent_of(i); parent >= 0) append_format(json, ",\"parent\":{}", parent);
    if (!children_[i].empty()) {
      append_text(json, ",\"children\":");
      append_list(json, children_[i], [&](int child) { append_number(json, child); });
    }
    json.push_back('}');
  }

  const Building& building_;
  std::vector<Entry> surfaces_;
  std::vector<std::array<int, kSurfaceNames.size()>> index_of_;
  std::vector<int> values_;
  std::vector<std::vector<int>> children_;
};

}  // namespace

void append_semantics(Json& json, const Building& building, const std::vector<int>& polygons,
                      bool is_solid) {
  Semantics(building, polygons).append_to(json, is_solid);
}

}  // namespace oriel::generator
