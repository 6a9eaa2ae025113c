#include "io/cityjson/carried_labels.h"

#include "io/cityjson/cityjson_geometry.h"
#include "io/cityjson/cityjson_source.h"
#include "io/cityjson/write/geometry_text.h"
#include "io/objects/label_members.h"

#include <algorithm>

namespace oriel {

namespace {

std::string text_of(const RawNode& node, std::string_view key) {
  const std::string_view value = node.value_of(key);
  return value.starts_with('"') ? decoded(value) : "";
}

/// Joins it to the feature with its id, if there is one already; without id or polygons it is none.
void add(CarriedLabels& labels, CarriedFeature feature) {
  if (feature.said.id.empty() || feature.polygons.empty()) return;
  const auto found =
      std::ranges::find(labels.features, feature.said.id,
                        [](const CarriedFeature& of) -> const std::string& { return of.said.id; });
  if (found == labels.features.end()) {
    labels.features.push_back(std::move(feature));
    return;
  }
  auto& polygons = found->polygons;
  polygons.insert(polygons.end(), feature.polygons.begin(), feature.polygons.end());
  std::ranges::sort(polygons);
  polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
}

struct Shape {
  detail::GeometryText text;
  std::string_view semantics;
};

Shape shape_of(const RawNode& geometry) {
  const auto kind = detail::kind_of_geometry(text_of(geometry, "type"));
  return {detail::geometry_of(geometry.value_of("boundaries"), kind ? kind->depth : 0, true),
          geometry.value_of("semantics")};
}

/// Reads the surfaces of the polygons that follow those that `labels` has already.
void read_surfaces(const Shape& shape, CarriedLabels& labels) {
  const std::size_t first = labels.types.size();
  labels.types.resize(first + shape.text.polygons.size());
  if (!RawNode::is_object(shape.semantics)) return;
  const auto surfaces = elements_of(RawNode(shape.semantics).value_of("surfaces"));
  const std::vector<int> numbers = detail::surface_numbers(shape.semantics, shape.text.shape);
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (!RawNode::is_object(surfaces[s])) continue;
    const RawNode surface(surfaces[s]);
    CarriedFeature feature{label_of(surface, kSurfaceMembers), {}};
    for (std::size_t polygon = 0; polygon < numbers.size(); ++polygon) {
      if (numbers[polygon] != static_cast<int>(s)) continue;
      labels.types[first + polygon] = text_of(surface, "type");
      feature.polygons.push_back(static_cast<int>(first + polygon));
    }
    add(labels, std::move(feature));
  }
}

}  // namespace

CarriedLabelReader::CarriedLabelReader(const Document& document) : document_(document) {
  if (!document.source) return;
  const std::string_view text = document.source->text;
  objects_.emplace(RawNode(text.substr(text.find('{'))).value_of("CityObjects"));
  for (std::size_t i = 0; i < objects_->size(); ++i) number_of_.try_emplace(objects_->key(i), i);
}

/// Its polygons are those of the building with the same corners, in the same order.
void CarriedLabelReader::read_installation(
    std::string_view object, const std::unordered_map<std::string_view, int>& polygon_of,
    CarriedLabels& labels) const {
  if (!RawNode::is_object(object)) return;
  const RawNode installation(object);
  const std::string_view attributes = installation.value_of("attributes");
  if (!RawNode::is_object(attributes)) return;
  CarriedFeature feature{label_of(RawNode(attributes), kInstallationMembers), {}};
  for (const std::string_view geometry : elements_of(installation.value_of("geometry"))) {
    if (!RawNode::is_object(geometry)) continue;
    for (const std::string_view polygon : shape_of(RawNode(geometry)).text.polygons)
      if (const auto found = polygon_of.find(polygon); found != polygon_of.end())
        feature.polygons.push_back(found->second);
  }
  std::ranges::sort(feature.polygons);
  add(labels, std::move(feature));
}

std::optional<CarriedLabels> CarriedLabelReader::labels_of(std::size_t building) const {
  if (!objects_) return std::nullopt;
  const GeometryPlace place = document_.source->places.at(building);
  const RawNode object(objects_->value(place.object));
  const std::string_view attributes = object.value_of("attributes");
  if (!RawNode::is_object(attributes) || !RawNode(attributes).find("oriel_pack"))
    return std::nullopt;
  CarriedLabels labels;
  std::unordered_map<std::string_view, int> polygon_of;
  const auto read_geometry = [&](GeometryPlace of) {
    const auto geometries = elements_of(RawNode(objects_->value(of.object)).value_of("geometry"));
    const Shape shape = shape_of(RawNode(geometries.at(of.geometry)));
    auto number = static_cast<int>(labels.types.size());
    for (const std::string_view polygon : shape.text.polygons)
      polygon_of.try_emplace(polygon, number++);
    read_surfaces(shape, labels);
  };
  read_geometry(place);
  if (const auto& joined = document_.source->joined; building < joined.size())
    for (const GeometryPlace of : joined[building]) read_geometry(of);
  for (const std::string_view child : elements_of(object.value_of("children"))) {
    if (!child.starts_with('"')) continue;
    const auto found = number_of_.find(decoded(child));
    if (found != number_of_.end())
      read_installation(objects_->value(found->second), polygon_of, labels);
  }
  return labels;
}

}  // namespace oriel
