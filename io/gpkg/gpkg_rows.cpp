#include "io/gpkg/gpkg_rows.h"

#include "io/gpkg/gpkg_geometry.h"
#include "io/gpkg/gpkg_row.h"
#include "io/objects/city_record.h"
#include "io/objects/label_members.h"
#include "kernel/base/index.h"
#include "model/description/attributes.h"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace oriel {

namespace detail {

namespace {

using PolygonList = std::vector<const std::vector<std::vector<int>>*>;

/// A feature of a building while its surfaces are gathered.
struct GatheredFeature {
  std::string id;
  /// What the surfaces, or else the installation, say of it.
  const CityMembers* members = nullptr;
  std::string written_as;
  PolygonList polygons;
};

GpkgValue gpkg_value(const CityValue& value) {
  if (value.get<std::monostate>() != nullptr) return {};
  if (const auto* text = value.get<std::string>()) return *text;
  if (const auto* whole = value.get<std::int64_t>()) return *whole;
  if (const auto* number = value.get<double>()) return *number;
  if (const auto* truth = value.get<bool>()) return *truth;
  std::string json;
  append_json(json, value);
  return json;
}

/// The names of oriel's own members in tables, where they need no prefix.
std::string column_of(const std::string& member) {
  constexpr std::string_view kPrefix = "oriel_";
  return member.starts_with(kPrefix) ? member.substr(kPrefix.size()) : member;
}

bool is_building(const CityObject& object) {
  return object.type == "Building" || object.type == "BuildingPart";
}

class RowMaker {
 public:
  RowMaker(const CityRecord& record, std::span<const FeatureRecord> features) : record_(record) {
    for (std::size_t i = 0; i < record.objects.size(); ++i)
      number_of_.try_emplace(record.objects[i].id, i);
    for (const FeatureRecord& feature : features)
      feature_of_.try_emplace({feature.building, feature.id}, &feature);
  }

  std::string rows() {
    for (const CityObject& object : record_.objects)
      if (is_building(object)) add_building(object);
    return std::move(rows_);
  }

 private:
  static void put(GpkgRow& row, std::string column, GpkgValue value,
                  GpkgRole role = GpkgRole::fixed) {
    row.cells.push_back({std::move(column), role, std::move(value)});
  }
  /// A text that is not there is no value.
  static void put_text(GpkgRow& row, std::string column, std::string_view text) {
    put(row, std::move(column), text.empty() ? GpkgValue() : GpkgValue(std::string(text)));
  }

  void put_geometry(GpkgRow& row, const PolygonList& polygons) const {
    row.geometry = gpkg_geometry(polygons, record_.vertices, row.box);
  }

  void add_building(const CityObject& object) {
    const CityGeometry* geometry = leading_geometry(object);
    GpkgRow row;
    row.table = GpkgTable::buildings;
    PolygonList polygons;
    if (geometry != nullptr)
      for_each_city_polygon(*geometry,
                            [&](const CityPolygon& one) { polygons.push_back(&one.rings); });
    put_geometry(row, polygons);
    put_text(row, "building", object.id);
    put_text(row, "type", object.type);
    put_text(row, "part_of", object.parents.empty() ? "" : object.parents[0]);
    put_text(row, "lod", geometry == nullptr ? "" : geometry->lod);
    for (const auto& [name, value] : object.attributes)
      put(row, name, gpkg_value(value), GpkgRole::attribute);
    const std::vector<GatheredFeature> features = gathered(object, geometry);
    std::map<std::string, std::int64_t> counts;
    for (const GatheredFeature& feature : features)
      if (const std::string_view label = label_of(feature); !label.empty())
        ++counts["count_" + std::string(label)];
    for (const auto& [column, count] : counts) put(row, column, count, GpkgRole::count);
    append_row(rows_, row);
    if (geometry != nullptr) add_surfaces(object, *geometry);
    for (const GatheredFeature& feature : features) add_feature(object, feature);
  }

  static std::string_view label_of(const GatheredFeature& feature) {
    return feature.members == nullptr ? std::string_view()
                                      : member_text(*feature.members, kLabelMember);
  }

  void add_surfaces(const CityObject& object, const CityGeometry& geometry) {
    std::vector<PolygonList> polygons(geometry.surfaces.size());
    for_each_city_polygon(geometry, [&](const CityPolygon& polygon) {
      if (polygon.surface >= 0) polygons[at(polygon.surface)].push_back(&polygon.rings);
    });
    for (std::size_t s = 0; s < geometry.surfaces.size(); ++s) {
      const CitySurface& surface = geometry.surfaces[s];
      GpkgRow row;
      row.table = GpkgTable::surfaces;
      put_geometry(row, polygons[s]);
      put_text(row, "building", object.id);
      put_text(row, "surface", surface.type);
      put(row, "parent",
          surface.parent < 0 ? GpkgValue()
                             : GpkgValue(std::int64_t{surface.parent} - static_cast<int>(s)),
          GpkgRole::row);
      put_text(row, "id", member_text(surface.members, kIdMember));
      put_verdict(row, &surface.members);
      put(row, "area_m2", area_m2(polygons[s]));
      put_rest(row, surface.members);
      append_row(rows_, row);
    }
  }

  static constexpr std::array kVerdict{kIdMember, kLabelMember, kNameMember, kScoreMember,
                                       kRuleMember};

  static void put_verdict(GpkgRow& row, const CityMembers* members) {
    const auto value = [&](std::string_view name) {
      const CityValue* found = members == nullptr ? nullptr : member_of(*members, name);
      return found == nullptr ? GpkgValue() : gpkg_value(*found);
    };
    put(row, "label", value(kLabelMember));
    put(row, "name", value(kNameMember));
    GpkgValue score = value(kScoreMember);
    if (const auto* whole = std::get_if<std::int64_t>(&score)) score = static_cast<double>(*whole);
    put(row, "score", std::move(score));
    put(row, "rule", value(kRuleMember));
  }

  static void put_rest(GpkgRow& row, const CityMembers& members) {
    for (const auto& [name, value] : members)
      if (std::ranges::find(kVerdict, name) == kVerdict.end())
        put(row, column_of(name), gpkg_value(value), GpkgRole::attribute);
  }

  [[nodiscard]] double area_m2(const PolygonList& polygons) const {
    double area = 0;
    for (const auto* rings : polygons) {
      Vec3 sum;
      for (const std::vector<int>& ring : *rings) sum = sum + area_vector(record_.vertices, ring);
      area += length(sum);
    }
    return area;
  }

  /// The features of a building in the order in which its surfaces and installations name them.
  std::vector<GatheredFeature> gathered(const CityObject& object, const CityGeometry* geometry) {
    std::vector<GatheredFeature> features;
    std::unordered_map<std::string, std::size_t> place_of;
    const auto feature_for = [&](std::string_view id) -> GatheredFeature& {
      const auto [found, is_new] = place_of.try_emplace(std::string(id), features.size());
      if (is_new) features.push_back({std::string(id), nullptr, "", {}});
      return features[found->second];
    };
    if (geometry != nullptr) gather_surfaces(*geometry, feature_for, features, 0);
    for (const std::string& child : object.children) {
      const CityObject& installation = record_.objects[number_of_.at(child)];
      if (is_building(installation)) continue;
      // The installation stands for the feature with all its polygons.
      GatheredFeature& feature = feature_for(installation.id);
      feature.members = &installation.attributes;
      feature.written_as = installation.type;
      feature.polygons.clear();
      if (const CityGeometry* own = leading_geometry(installation)) {
        for_each_city_polygon(
            *own, [&](const CityPolygon& one) { feature.polygons.push_back(&one.rings); });
        // One that oriel wrote shares polygons with what is known already.
        const bool is_ours =
            !installation.attributes.empty() && member_of(installation.attributes, kLabelMember);
        gather_surfaces(*own, feature_for, features, is_ours ? features.size() : 0);
      }
    }
    return features;
  }

  /// Features before number `first` have their polygons.
  template <class FeatureFor>
  static void gather_surfaces(const CityGeometry& geometry, const FeatureFor& feature_for,
                              const std::vector<GatheredFeature>& features, std::size_t first) {
    for_each_city_polygon(geometry, [&](const CityPolygon& polygon) {
      if (polygon.surface < 0) return;
      const CitySurface& surface = geometry.surfaces[at(polygon.surface)];
      const std::string_view id = member_text(surface.members, kIdMember);
      if (id.empty()) return;
      GatheredFeature& feature = feature_for(id);
      if (static_cast<std::size_t>(&feature - features.data()) < first) return;
      if (feature.members == nullptr) {
        feature.members = &surface.members;
        feature.written_as = surface.type;
      }
      feature.polygons.push_back(&polygon.rings);
    });
  }

  void add_feature(const CityObject& object, const GatheredFeature& feature) {
    GpkgRow row;
    row.table = GpkgTable::features;
    put_geometry(row, feature.polygons);
    put_text(row, "building", object.id);
    put_text(row, "id", feature.id);
    put_text(row, "written_as", feature.written_as);
    put_verdict(row, feature.members);
    const auto found = feature_of_.find({object.id, feature.id});
    if (found != feature_of_.end()) put_record(row, *found->second);
    if (feature.members != nullptr) put_rest(row, *feature.members);
    append_row(rows_, row);
  }

  static void put_record(GpkgRow& row, const FeatureRecord& record) {
    put(row, "margin", record.margin ? GpkgValue(*record.margin) : GpkgValue());
    put_text(row, "runner_up", record.runner_up);
    put_text(row, "host", record.host);
    put_text(row, "part_of", record.part_of);
    const auto& schema = feature_schema();
    for (std::size_t i = 0; i < record.attributes.size() && i < schema.size(); ++i) {
      GpkgValue value;
      if (const auto* text = std::get_if<std::string>(&record.attributes[i])) value = *text;
      if (const auto* number = std::get_if<double>(&record.attributes[i])) {
        if (schema[i].unit == Unit::yes_no)
          value = *number != 0;
        else if (schema[i].unit == Unit::count)
          value = static_cast<std::int64_t>(*number);
        else
          value = *number;
      }
      put(row, record_name(schema[i]), std::move(value));
    }
  }

  const CityRecord& record_;
  std::unordered_map<std::string_view, std::size_t> number_of_;
  std::map<std::pair<std::string, std::string>, const FeatureRecord*> feature_of_;
  std::string rows_;
};

}  // namespace

}  // namespace detail

std::string gpkg_rows(std::string_view text, const Document& document,
                      std::span<const FeatureRecord> features) {
  if (text.empty()) return {};
  const Transform transform = document.source ? document.source->transform : Transform{};
  const detail::CityRecord record = detail::city_record(text, transform);
  return detail::RowMaker(record, features).rows();
}

}  // namespace oriel
