#include "kernel/io/cityjson/object_survey.h"

#include "kernel/io/cityjson/cityjson_objects.h"
#include "kernel/io/cityjson/cityjson_source.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string_view>

#include <simdjson.h>

namespace oriel {

namespace {

namespace dom = simdjson::dom;

bool has_own_geometry(dom::object object) {
  const auto geometry = detail::as_array(detail::member(object, "geometry"));
  if (!geometry || geometry->begin() == geometry->end()) return false;
  const auto attributes = detail::as_object(detail::member(object, "attributes"));
  return !attributes || !detail::member(*attributes, "oriel_geometry");
}

void add_unread(dom::object objects, ObjectSurvey& out) {
  for (const dom::key_value_pair field : objects) {
    const auto object = detail::as_object(field.value);
    const auto type = object ? detail::as_string(detail::member(*object, "type")) : std::nullopt;
    if (!type || type == "Building" || type == "BuildingPart" || !has_own_geometry(*object))
      continue;
    out.unread.push_back({std::string(field.key), std::string(*type)});
  }
}

void add_families(const std::vector<detail::ObjectEntry>& entries, const Document& document,
                  ObjectSurvey& out) {
  std::vector<detail::Relative> members;
  for (const detail::ObjectEntry& entry : entries) members.push_back({entry.id, entry.relatives});
  const std::vector<std::size_t> families = detail::families_of(members);
  const auto& places = document.source->places;
  for (std::size_t i = 0; i < document.buildings.size() && i < places.size(); ++i) {
    const auto entry =
        std::ranges::lower_bound(entries, places[i].object, {}, &detail::ObjectEntry::number);
    if (entry != entries.end() && entry->number == places[i].object)
      out.families[i] = families[static_cast<std::size_t>(entry - entries.begin())];
  }
}

}  // namespace

ObjectSurvey survey(const Document& document) {
  ObjectSurvey out;
  out.families.resize(document.buildings.size());
  const bool is_gml = document.format == Format::citygml;
  if (!is_gml) std::iota(out.families.begin(), out.families.end(), std::size_t{0});
  if (!document.source) return out;
  dom::parser parser;
  dom::object root;
  if (parser.parse(document.source->text).get(root) != simdjson::SUCCESS) return out;
  const auto objects = detail::as_object(detail::member(root, "CityObjects"));
  if (!objects) return out;
  add_unread(*objects, out);
  if (is_gml) return out;
  // Whether a number may stand for a level of detail was judged when the document was read.
  const auto entries = detail::list_objects(*objects, true);
  for (const detail::ObjectEntry& entry : entries) {
    for (const detail::GeometryEntry& geometry : entry.geometries) out.lods.insert(geometry.lod);
    if (entry.has_instances && entry.geometries.empty())
      out.unread.push_back({std::string(entry.id), "GeometryInstance"});
  }
  add_families(entries, document, out);
  return out;
}

}  // namespace oriel
