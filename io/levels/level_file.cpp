#include "io/levels/level_file.h"

#include "io/cityjson/cityjson_geometry.h"
#include "io/cityjson/cityjson_source.h"
#include "io/cityjson/lod_name.h"
#include "io/cityjson/write/fresh_cityjson.h"
#include "io/json/text.h"
#include "io/levels/written_grid.h"
#include "io/objects/label_members.h"

#include <algorithm>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

namespace oriel {

namespace {

using nlohmann::ordered_json;

Vec3 vector_of(const ordered_json& node) {
  return {node.at(0).get<double>(), node.at(1).get<double>(), node.at(2).get<double>()};
}

class LevelReader {
 public:
  LevelReader(const ordered_json& root, const ordered_json& header, const std::string& lod)
      : objects_(root.at("CityObjects")), vertices_(root.at("vertices")), lod_(lod) {
    const ordered_json& transform = header.at("transform");
    scale_ = vector_of(transform.at("scale"));
    translate_ = vector_of(transform.at("translate"));
  }

  LevelState state(const std::string& id) {
    LevelState state;
    state.building = id;
    const ordered_json& object = objects_.at(id);
    if (const auto found = object.find("attributes"); found != object.end())
      for (const auto& [name, value] : found->items())
        if (is_of_state(name)) state.attributes[name] = member_value(value);
    if (state.attributes.contains("oriel_member_of")) return state;
    add_geometry(chosen_geometry(object.at("geometry")), state);
    if (const auto children = object.find("children"); children != object.end())
      for (const ordered_json& child : *children) add_installation(child.get<std::string>(), state);
    return state;
  }

 private:
  [[nodiscard]] MicrometreRing ring_of(const ordered_json& numbers) const {
    MicrometreRing ring;
    for (const ordered_json& number : numbers)
      ring.push_back(
          grid_point(vertices_.at(number.get<std::size_t>()).get<std::array<std::int64_t, 3>>(),
                     scale_, translate_));
    std::ranges::rotate(ring, std::ranges::min_element(ring));
    return ring;
  }

  /// Calls visit(polygon, its value) with each polygon under `boundaries`, nested `depth` deep.
  template <class Visit>
  static void for_each_polygon(const ordered_json& boundaries, const ordered_json* values,
                               int depth, const Visit& visit) {
    for (std::size_t i = 0; i < boundaries.size(); ++i) {
      const ordered_json* value =
          values != nullptr && values->is_array() ? &values->at(i) : nullptr;
      if (depth == 0)
        visit(boundaries[i], value);
      else
        for_each_polygon(boundaries[i], value, depth - 1, visit);
    }
  }

  /// How many arrays stand above the polygons of a geometry; nothing for one that has none.
  static std::optional<int> depth_of(const ordered_json& geometry) {
    const auto kind = detail::kind_of_geometry(geometry.at("type").get<std::string>());
    return kind ? std::optional(kind->depth) : std::nullopt;
  }

  /// Of the level of detail, or of the highest, the first solid or else the first surfaces, as the
  /// Reader chooses.
  [[nodiscard]] const ordered_json& chosen_geometry(const ordered_json& geometries) const {
    const ordered_json* chosen = nullptr;
    int depth = 0;
    for (const ordered_json& geometry : geometries) {
      const auto its = depth_of(geometry);
      if (!its) continue;
      if (!lod_.empty() && detail::lod_name(geometry.at("lod").dump()) != lod_) continue;
      const bool is_same = chosen != nullptr && geometry.at("lod") == chosen->at("lod");
      const bool is_solid_first = is_same && depth == 0 && *its > 0;
      if (chosen != nullptr && !is_solid_first && !(geometry.at("lod") > chosen->at("lod")))
        continue;
      chosen = &geometry;
      depth = *its;
    }
    if (chosen == nullptr) throw std::runtime_error("it has no geometry");
    return *chosen;
  }

  void add_geometry(const ordered_json& geometry, LevelState& state) const {
    const auto semantics = geometry.find("semantics");
    const ordered_json* values = semantics == geometry.end() ? nullptr : &semantics->at("values");
    for_each_polygon(geometry.at("boundaries"), values, *depth_of(geometry),
                     [&](const ordered_json& polygon, const ordered_json* value) {
                       MicrometreRing outer = ring_of(polygon.at(0));
                       if (outer.size() < 3) return;
                       LevelFacet facet;
                       for (std::size_t i = 1; i < polygon.size(); ++i)
                         facet.holes.push_back(ring_of(polygon[i]));
                       std::erase_if(facet.holes, [](const auto& hole) { return hole.size() < 3; });
                       std::ranges::sort(facet.holes);
                       if (value != nullptr && value->is_number()) {
                         const ordered_json& surface =
                             semantics->at("surfaces").at(value->get<std::size_t>());
                         facet.type = surface.at("type").get<std::string>();
                         facet.label = label_of(surface, kSurfaceMembers);
                       }
                       state.facets.emplace(std::move(outer), std::move(facet));
                     });
  }

  /// Children that share facets of the building and are labelled.
  void add_installation(const std::string& id, LevelState& state) const {
    const auto object = objects_.find(id);
    if (object == objects_.end() || !object->contains("attributes") ||
        !object->at("attributes").contains("oriel_geometry"))
      return;
    state.installations[id] = label_of(object->at("attributes"), kInstallationMembers);
    for (const ordered_json& polygon : object->at("geometry").at(0).at("boundaries")) {
      const auto facet = state.facets.find(ring_of(polygon.at(0)));
      if (facet == state.facets.end()) throw std::runtime_error("'" + id + "' has its own facets");
      auto& ids = facet->second.installations;
      ids.insert(std::ranges::lower_bound(ids, id), id);
    }
  }

  const ordered_json& objects_;
  const ordered_json& vertices_;
  const std::string& lod_;
  Vec3 scale_, translate_;
};

}  // namespace

Checked<std::vector<LevelState>> read_level(std::string_view text, const std::string& file,
                                            const std::vector<std::string>& ids,
                                            std::string_view header, const std::string& lod) {
  Checked<std::vector<LevelState>> out;
  std::vector<LevelState> states;
  std::string building;
  try {
    const ordered_json root = ordered_json::parse(text);
    const ordered_json above = header.empty() ? ordered_json() : ordered_json::parse(header);
    LevelReader reader(root, header.empty() ? root : above, lod);
    for (const std::string& id : ids) {
      building = id;
      states.push_back(reader.state(id));
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& fault) {
    std::string sentence = "is not a level of a series: ";
    sentence += fault.what();
    Issue issue = error_in({file, 0}, {Code::E120, std::move(sentence)});
    issue.place.building = building;
    out.issues.push_back(std::move(issue));
    return out;
  }
  out.value = std::move(states);
  return out;
}

LevelState state_as_read(const Document& document, const Building& building) {
  const CityJsonSource fresh =
      document.source ? CityJsonSource{} : detail::fresh_cityjson(document.buildings);
  const CityJsonSource& source = document.source ? *document.source : fresh;
  const auto [scale, translate] = source.transform;
  ordered_json header;
  header["transform"]["scale"] = {scale.x, scale.y, scale.z};
  header["transform"]["translate"] = {translate.x, translate.y, translate.z};
  auto states = read_level(source.text, document.name, {building.id}, header.dump(), building.lod);
  if (!states.value) throw GeometryError(states.issues.front().sentence);
  return std::move(states.value->front());
}

}  // namespace oriel
