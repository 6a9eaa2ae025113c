#include "io/citygml/write/gml_levels.h"

#include "kernel/base/index.h"
#include "model/labelled_building.h"

#include <algorithm>
#include <array>
#include <utility>

namespace oriel::detail {

namespace {

bool is_of_buildings(std::string_view type) { return type == "Building" || type == "BuildingPart"; }

char level_of(const CityGeometry& geometry) {
  const char level = geometry.lod.empty() ? '2' : geometry.lod[0];
  return level >= '0' && level <= '3' ? level : '3';
}

bool has_openings(const CityGeometry* geometry) {
  return geometry != nullptr && std::ranges::any_of(geometry->surfaces, [](const CitySurface& one) {
           return is_opening_type(one.type);
         });
}

}  // namespace

bool is_boundary(std::string_view type) {
  constexpr std::array<std::string_view, 6> kTypes{"RoofSurface",         "WallSurface",
                                                   "GroundSurface",       "ClosureSurface",
                                                   "OuterCeilingSurface", "OuterFloorSurface"};
  return std::ranges::find(kTypes, type) != kTypes.end();
}

GmlRecordLevels::GmlRecordLevels(const CityRecord& record, GmlVersion version)
    : version_(version), levels_(record.objects.size()) {
  for (std::size_t i = 0; i < record.objects.size(); ++i) choose(record.objects[i], levels_[i]);
  if (version == GmlVersion::two) raise_openings(record);
}

void GmlRecordLevels::choose(const CityObject& object, GmlLevels& levels) const {
  const bool is_building = is_of_buildings(object.type);
  for (const CityGeometry& geometry : object.geometries) {
    char level = level_of(geometry);
    if (version_ == GmlVersion::two && !is_building) level = std::max(level, '2');
    GmlLevel& chosen = levels[level];
    const CityGeometry*& place = geometry.is_solid() ? chosen.solid : chosen.surfaces;
    if (place == nullptr || says_more(geometry, *place)) place = &geometry;
  }
}

/// The objects of a record that are linked go up together: their polygons are shared.
void GmlRecordLevels::raise_openings(const CityRecord& record) {
  const bool has_some = std::ranges::any_of(levels_, [](const GmlLevels& levels) {
    const auto found = levels.find('2');
    return found != levels.end() &&
           (has_openings(found->second.solid) || has_openings(found->second.surfaces));
  });
  if (!has_some) return;
  // Of a whole file only the buildings that have some, and what stands on them.
  std::map<std::string_view, std::size_t> number_of;
  for (std::size_t i = 0; i < record.objects.size(); ++i) number_of[record.objects[i].id] = i;
  std::vector<std::size_t> root(record.objects.size());
  for (std::size_t i = 0; i < root.size(); ++i) {
    std::size_t top = i;
    for (std::size_t steps = 0; steps < root.size() && !record.objects[top].parents.empty();
         ++steps)
      top = number_of.at(record.objects[top].parents[0]);
    root[i] = top;
  }
  std::vector<bool> wants(root.size()), may(root.size(), true);
  for (std::size_t i = 0; i < root.size(); ++i) {
    if (levels_[i].contains('3')) may[root[i]] = false;
    const auto found = levels_[i].find('2');
    if (found != levels_[i].end() &&
        (has_openings(found->second.solid) || has_openings(found->second.surfaces)))
      wants[root[i]] = true;
  }
  for (std::size_t i = 0; i < root.size(); ++i) {
    if (!wants[root[i]] || !may[root[i]]) continue;
    auto node = levels_[i].extract('2');
    if (node.empty()) continue;
    node.key() = '3';
    levels_[i].insert(std::move(node));
  }
}

std::vector<int> GmlRecordLevels::surfaces_of(const CityGeometry& geometry, char lod) const {
  const bool has_surfaces = version_ == GmlVersion::three || lod >= '2';
  const bool has_fillings = version_ == GmlVersion::three || lod >= '3';
  std::vector<int> written;
  for (const CitySurface& surface : geometry.surfaces) {
    const auto number = static_cast<int>(written.size());
    int in = is_boundary(surface.type) ? number : -1;
    if (is_opening_type(surface.type) && has_fillings) in = number;
    if (is_opening_type(surface.type) && !has_fillings && surface.parent >= 0 &&
        is_boundary(geometry.surfaces[at(surface.parent)].type))
      in = surface.parent;
    written.push_back(has_surfaces ? in : -1);
  }
  std::vector<int> surfaces;
  for_each_city_polygon(geometry, [&](const CityPolygon& polygon) {
    surfaces.push_back(polygon.surface < 0 ? -1 : written[at(polygon.surface)]);
  });
  return surfaces;
}

}  // namespace oriel::detail
