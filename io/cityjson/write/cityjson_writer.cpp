#include "io/cityjson/cityjson_geometry.h"
#include "io/cityjson/lod_name.h"
#include "io/cityjson/write/fresh_cityjson.h"
#include "io/cityjson/write/geometry_text.h"
#include "io/cityjson/write/semantics_text.h"
#include "io/cityjson/write/vertex_pool.h"
#include "io/json/raw_json.h"
#include "io/writer.h"
#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace oriel {

namespace {

/// The root object of `text`, which is JSON: only white space stands around it.
std::string_view root_of(std::string_view text) {
  const std::size_t start = text.find('{');
  return text.substr(start, text.rfind('}') + 1 - start);
}

/// Sets members in the object under `key`, which is made if it is not there.
void set_members(RawNode& node, std::string_view key, const Members& members) {
  if (members.empty()) return;
  const std::string_view existing = node.value_of(key);
  RawNode object(RawNode::is_object(existing) ? existing : "{}");
  for (const auto& [name, value] : members) {
    std::string text;
    std::visit([&](const auto& known) { append_json(text, known); }, value);
    object.set(name, std::move(text));
  }
  node.set(key, object.text());
}

/// Takes members out of the object under `key`.
void drop_members(RawNode& node, std::string_view key, const std::vector<std::string>& names) {
  const std::string_view existing = node.value_of(key);
  if (names.empty() || !RawNode::is_object(existing)) return;
  RawNode object(existing);
  for (const std::string& name : names) object.erase(name);
  node.set(key, object.text());
}

/// Adds to the array of ids under `key` those that are not in it.
void add_ids(RawNode& node, std::string_view key, const std::vector<Installation>& added) {
  const std::string_view existing = node.value_of(key);
  RawNode array(RawNode::is_array(existing) ? existing : "[]");
  std::unordered_set<std::string> ids;
  for (std::size_t i = 0; i < array.size(); ++i) ids.insert(decoded(array.value(i)));
  bool is_changed = false;
  for (const Installation& installation : added) {
    if (!ids.insert(installation.id).second) continue;
    std::string text;
    append_json(text, std::string_view(installation.id));
    array.push_back(std::move(text));
    is_changed = true;
  }
  if (is_changed) node.set(key, array.text());
}

/// Takes ids out of the array under `key`; an array that gets empty goes too.
bool remove_ids(RawNode& node, std::string_view key, const std::unordered_set<std::string>& ids) {
  const std::string_view existing = node.value_of(key);
  if (!RawNode::is_array(existing)) return false;
  RawNode array(existing);
  std::size_t removed = 0;
  for (std::size_t i = 0; i < array.size(); ++i) {
    if (!ids.contains(decoded(array.value(i)))) continue;
    array.erase(i);
    ++removed;
  }
  if (removed == array.size() && removed > 0)
    node.erase(key);
  else if (removed > 0)
    node.set(key, array.text());
  return removed > 0;
}

std::vector<std::string_view> arrays_of(const CityJsonSource& source) {
  std::vector<std::string_view> arrays;
  for (const auto [begin, end] : source.arrays)
    arrays.push_back(std::string_view(source.text).substr(begin, end - begin));
  return arrays;
}

}  // namespace

class CityJsonText::State {
 public:
  State(std::shared_ptr<const CityJsonSource> source, const Document& document,
        const WriteOptions& options)
      : options_(options),
        emptied_(options.emptied.begin(), options.emptied.end()),
        source_owner_(std::move(source)),
        source_(*source_owner_),
        document_(document),
        arrays_(arrays_of(source_)),
        root_(root_of(source_.text), arrays_),
        objects_(root_.value_of("CityObjects"), arrays_) {
    for (std::size_t i = 0; i < document.buildings.size(); ++i)
      building_of_.try_emplace(document.buildings[i].id, i);
    if (!emptied_.empty()) make_pool();
  }

  void relabel(const LabelledBuilding& labelled) {
    const std::size_t index = building_index(labelled.building);
    const GeometryPlace place = source_.places[index];
    if (emptied_.contains(labelled.building)) return empty(place, labelled);
    if (labelled.geometry) make_pool();
    RawNode object(objects_.value(place.object), arrays_);
    RawNode geometries(object.value_of("geometry"), arrays_);
    const bool is_emptied = place.geometry == kNoGeometry;
    const std::size_t number = is_emptied ? put_back(geometries, document_.buildings[index].lod)
                                          : make_room(geometries, place, labelled);
    RawNode geometry(geometries.value(number), arrays_);
    std::vector<std::string> facets;
    std::vector<std::string_view> polygons;
    if (labelled.geometry) {
      facets = replace_geometry(geometry, labelled, document_.buildings[index].frame);
      polygons.assign(facets.begin(), facets.end());
    } else {
      polygons = fill_geometry(geometry, labelled, own_polygons(index));
    }
    if (labelled.geometry)
      drop_joined(index, *labelled.geometry);
    else
      fill_joined(index, labelled, polygons);
    if (!labelled.lod.empty() && !is_emptied) {
      const RawNode source(geometries.value(place.geometry), arrays_);
      geometry.set("lod", detail::lod_text(labelled.lod, source.value_of("lod")));
    }
    // While what `polygons` are slices of is there.
    std::vector<std::string> installations;
    for (const Installation& installation : labelled.installations)
      installations.push_back(
          installation_text(installation, labelled, polygons, geometry.value_of("lod")));
    geometries.set(number, std::move(geometry));
    object.set("geometry", std::move(geometries));
    if (labelled.geometry) object.erase("geographicalExtent");
    if (labelled.geometry && !labelled.keeps_semantics) find_outdated(object, labelled);
    drop_members(object, "attributes", labelled.dropped_attributes);
    set_members(object, "attributes", labelled.attributes);
    add_ids(object, "children", labelled.installations);
    objects_.set(place.object, object.text());
    for (std::size_t i = 0; i < installations.size(); ++i)
      put_object(labelled.installations[i].id, std::move(installations[i]));
  }

  void finish() {
    if (std::exchange(is_finished_, true)) return;
    gone_.insert(options_.gone.begin(), options_.gone.end());
    std::unordered_set<std::string> leaving = without_relatives();
    leaving.insert(options_.removed.begin(), options_.removed.end());
    leaving.insert(outdated_.begin(), outdated_.end());
    if (!leaving.empty()) remove(leaving);
    is_nothing_ = !gone_.empty() && source_.is_feature && has_nothing();
    if (is_nothing_) return;
    if (pool_) exchange_vertices();
    root_.set("CityObjects", std::move(objects_));
  }

  /// Nothing is to be written.
  [[nodiscard]] bool is_nothing() const { return is_nothing_; }

  [[nodiscard]] const RawNode& root() const { return root_; }
  /// What stands before and behind the root.
  [[nodiscard]] std::string_view head() const {
    const std::string_view text = source_.text;
    return text.substr(0, text.find('{'));
  }
  [[nodiscard]] std::string tail() const {
    const bool is_line =
        document_.format == Format::cityjson_seq || document_.format == Format::citygml;
    return source_.text.substr(source_.text.rfind('}') + 1) + (is_line ? "\n" : "");
  }

 private:
  [[nodiscard]] std::size_t building_index(const std::string& id) const {
    const auto found = building_of_.find(id);
    if (found == building_of_.end())
      throw std::logic_error("no building '" + id + "' in " + document_.name);
    return found->second;
  }

  /// Starts the exchange of vertices if a geometry is replaced.
  void make_pool() {
    if (pool_) return;
    if (!source_.is_feature)
      digits_ = std::max(options_.finer_digits, detail::finer_digits(source_.transform));
    pool_.emplace(root_.value_of("vertices"), source_.transform, digits_);
  }

  void empty(GeometryPlace place, const LabelledBuilding& labelled) {
    RawNode object(objects_.value(place.object), arrays_);
    if (place.geometry != kNoGeometry) {
      RawNode geometries(object.value_of("geometry"), arrays_);
      geometries.erase(place.geometry);
      object.set("geometry", std::move(geometries));
      object.erase("geographicalExtent");
    }
    drop_members(object, "attributes", labelled.dropped_attributes);
    set_members(object, "attributes", labelled.attributes);
    objects_.set(place.object, object.text());
  }

  /// A geometry for a building that was read without one.
  static std::size_t put_back(RawNode& geometries, const std::string& lod) {
    RawNode geometry(R"({"type":"Solid"})");
    geometry.set("lod", detail::lod_text(lod, {}));
    geometries.push_back(geometry.text());
    return geometries.size() - 1;
  }

  /// Which element of "geometry" a labelled building is written to. Where it is redrawn, or gets a
  /// level of detail, other geometries of that level leave, so that an object never has two.
  std::size_t make_room(RawNode& geometries, GeometryPlace place,
                        const LabelledBuilding& labelled) {
    std::size_t number = place.geometry;
    const bool is_redrawn = labelled.geometry && !labelled.keeps_semantics;
    if (labelled.lod.empty() && !is_redrawn) return number;
    const std::string& level = labelled.lod.empty()
                                   ? document_.buildings[building_index(labelled.building)].lod
                                   : labelled.lod;
    if (!has_place_.insert(labelled.building).second) {
      geometries.push_back(R"({"type":"Solid"})");
      number = geometries.size() - 1;
    }
    for (std::size_t i = 0; i < geometries.size(); ++i) {
      if (i == number || geometries.is_erased(i) || !RawNode::is_object(geometries.value(i)))
        continue;
      const std::string_view lod = RawNode(geometries.value(i)).value_of("lod");
      if (detail::lod_name(lod) == level) geometries.erase(i);
    }
    return number;
  }

  /// Polygons of a document's building, by their numbers.
  struct PolygonRange {
    std::size_t first = 0;
    std::size_t end = 0;

    [[nodiscard]] std::size_t size_within(std::size_t size) const {
      return std::min(end, size) - std::min(first, size);
    }
    [[nodiscard]] bool contains(int polygon) const {
      return static_cast<std::size_t>(polygon) >= first && static_cast<std::size_t>(polygon) < end;
    }
  };

  /// Those that a building has itself.
  [[nodiscard]] PolygonRange own_polygons(std::size_t building) const {
    const Building& of = document_.buildings[building];
    return {0, of.installations.empty() ? of.polygons.size() : of.installations[0].first_polygon};
  }

  /// Those of one of the installations that were joined to it.
  [[nodiscard]] PolygonRange joined_polygons(std::size_t building, std::size_t k) const {
    const Building& of = document_.buildings[building];
    const bool is_last = k + 1 == of.installations.size();
    return {of.installations[k].first_polygon,
            is_last ? of.polygons.size() : of.installations[k + 1].first_polygon};
  }

  [[nodiscard]] std::span<const GeometryPlace> joined_to(std::size_t building) const {
    if (building >= source_.joined.size()) return {};
    return source_.joined[building];
  }

  /// Adds the labels to the geometries of installations that were joined to a building, and the
  /// texts of their polygons to `polygons` if these are asked for.
  void fill_joined(std::size_t building, const LabelledBuilding& labelled,
                   std::vector<std::string_view>& polygons) {
    const auto places = joined_to(building);
    for (std::size_t k = 0; k < places.size(); ++k) {
      RawNode object(objects_.value(places[k].object), arrays_);
      RawNode geometries(object.value_of("geometry"), arrays_);
      RawNode geometry(geometries.value(places[k].geometry), arrays_);
      const auto more = fill_geometry(geometry, labelled, joined_polygons(building, k));
      polygons.insert(polygons.end(), more.begin(), more.end());
      geometries.set(places[k].geometry, std::move(geometry));
      object.set("geometry", std::move(geometries));
      objects_.set(places[k].object, object.text());
    }
  }

  /// Takes the geometry from installations whose polygons are part of the building's new one.
  void drop_joined(std::size_t building, const Solid& solid) {
    const auto places = joined_to(building);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const PolygonRange range = joined_polygons(building, k);
      const bool is_part = std::ranges::any_of(solid.facets, [&](const Facet& facet) {
        return std::ranges::any_of(facet.polygons, [&](int p) { return range.contains(p); });
      });
      if (!is_part || !has_dropped_.insert(places[k].object).second) continue;
      RawNode object(objects_.value(places[k].object), arrays_);
      RawNode geometries(object.value_of("geometry"), arrays_);
      const bool is_only = geometries.size() == 1;
      geometries.erase(places[k].geometry);
      if (is_only)
        object.erase("geometry");
      else
        object.set("geometry", std::move(geometries));
      objects_.set(places[k].object, object.text());
    }
  }

  /// Adds the labels to a geometry that stays. Returns the texts of its polygons if an installation
  /// shares them.
  [[nodiscard]] std::vector<std::string_view> fill_geometry(RawNode& geometry,
                                                            const LabelledBuilding& labelled,
                                                            PolygonRange range) const {
    const auto kind = detail::kind_of_geometry(decoded(geometry.value_of("type")));
    auto [shape, polygons] = detail::geometry_of(geometry.value_of("boundaries"), kind->depth,
                                                 !labelled.installations.empty());
    const std::string_view there = geometry.value_of("semantics");
    const std::string_view existing =
        options_.existing == ExistingSemantics::replace ? std::string_view() : there;
    const std::size_t size = labelled.surface_of_polygon.size();
    const std::span<const int> wanted =
        std::span(labelled.surface_of_polygon)
            .subspan(std::min(range.first, size), range.size_within(size));
    std::string semantics = detail::filled_semantics(existing, shape, wanted, labelled.surfaces,
                                                     options_.existing == ExistingSemantics::keep);
    if (semantics != there) geometry.set("semantics", std::move(semantics));
    return std::move(polygons);
  }

  /// Puts the labelled building's own geometry in the place of the one that is there. Returns the
  /// texts of its facets.
  std::vector<std::string> replace_geometry(RawNode& geometry, const LabelledBuilding& labelled,
                                            const Frame& frame) {
    detail::SolidText solid =
        detail::solid_text(*labelled.geometry, pool_->add({&*labelled.geometry, &frame}));
    std::vector<int> surfaces;
    for (const int facet : solid.order) {
      const auto index = static_cast<std::size_t>(facet);
      const bool has_surface = index < labelled.surface_of_polygon.size();
      surfaces.push_back(has_surface ? labelled.surface_of_polygon[index] : -1);
    }
    const std::string existing =
        labelled.keeps_semantics ? carried_semantics(geometry, labelled, solid) : "";
    std::string type;
    append_json(type, solid.type);
    geometry.set("type", std::move(type));
    geometry.set("boundaries", std::move(solid.boundaries));
    for (const std::string_view key : {"semantics", "material", "texture"}) geometry.erase(key);
    std::string semantics =
        detail::filled_semantics(existing, solid.shape, surfaces, labelled.surfaces);
    if (!semantics.empty()) geometry.set("semantics", std::move(semantics));
    return std::move(solid.facets);
  }

  /// What the facets that are written keep of the geometry's semantics.
  static std::string carried_semantics(const RawNode& geometry, const LabelledBuilding& labelled,
                                       const detail::SolidText& solid) {
    const auto kind = detail::kind_of_geometry(decoded(geometry.value_of("type")));
    const auto old = detail::geometry_of(geometry.value_of("boundaries"), kind->depth, false);
    int count = 0;
    for (const auto& shells : old.shape.counts)
      for (const int polygons : shells) count += polygons;
    std::vector<std::vector<int>> sources;
    for (const int facet : solid.order) {
      const auto& polygons = labelled.geometry->facets.at(static_cast<std::size_t>(facet)).polygons;
      const bool is_own = std::ranges::all_of(polygons, [&](int p) { return p < count; });
      sources.push_back(is_own ? polygons : std::vector<int>{});
    }
    return detail::carried_semantics(geometry.value_of("semantics"), old.shape, solid.shape,
                                     sources);
  }

  static std::string installation_text(const Installation& installation,
                                       const LabelledBuilding& labelled,
                                       const std::vector<std::string_view>& polygons,
                                       std::string_view lod) {
    constexpr std::size_t kUsual = 1024;  // bytes without the boundaries
    std::string text;
    std::size_t size = kUsual;
    for (const int polygon : installation.polygons)
      size += polygons.at(static_cast<std::size_t>(polygon)).size() + 1;
    text.reserve(size);
    text += R"({"type":"BuildingInstallation","attributes":{)";
    detail::append_label(text, installation.label);
    append_field(text, "oriel_geometry", std::string_view("shared"));
    text += R"(},"parents":[)";
    append_json(text, std::string_view(labelled.building));
    text += R"(],"geometry":[{"type":"MultiSurface","lod":)";
    text += lod;
    text += R"(,"boundaries":[)";
    std::vector<int> surfaces;
    surfaces.reserve(installation.polygons.size());
    for (std::size_t i = 0; i < installation.polygons.size(); ++i) {
      const std::string_view polygon = polygons[static_cast<std::size_t>(installation.polygons[i])];
      if (polygon.empty()) continue;
      if (!surfaces.empty()) text += ',';
      text += polygon;
      surfaces.push_back(i < installation.surfaces.size() ? installation.surfaces[i] : -1);
    }
    text += ']';
    const detail::GeometryShape shape{0, {{static_cast<int>(surfaces.size())}}};
    const std::string semantics = detail::filled_semantics("", shape, surfaces, labelled.surfaces);
    if (!semantics.empty()) {
      text += R"(,"semantics":)";
      text += semantics;
    }
    text += "}]}";
    return text;
  }

  /// Installations that only repeat polygons of the solid that the building had, and are not
  /// written again with the new one, leave.
  void find_outdated(const RawNode& object, const LabelledBuilding& labelled) {
    for (const std::string& child : ids_in(object, "children")) {
      if (std::ranges::find(labelled.installations, child, &Installation::id) !=
          labelled.installations.end())
        continue;
      number_objects();
      const auto found = object_of_.find(child);
      if (found == object_of_.end() || !RawNode::is_object(objects_.value(found->second))) continue;
      const RawNode installation(objects_.value(found->second), arrays_);
      const std::string_view attributes = installation.value_of("attributes");
      if (RawNode::is_object(attributes) &&
          RawNode(attributes).value_of("oriel_geometry") == R"("shared")" &&
          is_at_lod(installation, document_.buildings[building_index(labelled.building)].lod))
        outdated_.insert(child);
    }
  }

  /// All its geometries are.
  [[nodiscard]] bool is_at_lod(const RawNode& object, std::string_view lod) const {
    const RawNode geometries(object.value_of("geometry"), arrays_);
    for (std::size_t i = 0; i < geometries.size(); ++i)
      if (detail::lod_name(RawNode(geometries.value(i), arrays_).value_of("lod")) != lod)
        return false;
    return true;
  }

  void number_objects() {
    if (object_of_.empty())
      for (std::size_t i = 0; i < objects_.size(); ++i) object_of_.try_emplace(objects_.key(i), i);
  }

  /// Replaces the CityObject `id`, or appends it.
  void put_object(const std::string& id, std::string text) {
    number_objects();
    const auto [found, is_new] = object_of_.try_emplace(id, objects_.size());
    if (is_new)
      objects_.append(id, std::move(text));
    else
      objects_.set(found->second, std::move(text));
  }

  void remove(const std::unordered_set<std::string>& ids) {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (ids.contains(objects_.key(i))) {
        objects_.erase(i);
        continue;
      }
      if (!RawNode::is_object(objects_.value(i))) continue;
      RawNode object(objects_.value(i));
      const bool lost_children = remove_ids(object, "children", ids);
      const bool lost_parents = remove_ids(object, "parents", ids);
      if (lost_children || lost_parents) objects_.set(i, object.text());
    }
  }

  [[nodiscard]] bool has_nothing() const {
    for (std::size_t i = 0; i < objects_.size(); ++i)
      if (!objects_.is_erased(i)) return false;
    return true;
  }

  static std::vector<std::string> ids_in(const RawNode& object, std::string_view key) {
    std::vector<std::string> ids;
    const std::string_view text = object.value_of(key);
    if (!RawNode::is_array(text)) return ids;
    const RawNode array(text);
    for (std::size_t i = 0; i < array.size(); ++i) ids.push_back(decoded(array.value(i)));
    return ids;
  }

  /// Children that are no buildings themselves.
  void add_installations_of(const RawNode& object, std::unordered_set<std::string>& ids) const {
    for (const std::string& child : ids_in(object, "children"))
      if (!building_of_.contains(child)) ids.insert(child);
  }

  /// The buildings that are gone with their children, the installations of those that are bared,
  /// and what is no building that was read, an outline at most, and keeps none of its children.
  [[nodiscard]] std::unordered_set<std::string> without_relatives() const {
    std::unordered_set<std::string> ids = gone_;
    if (gone_.empty() && options_.bared.empty()) return ids;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (!RawNode::is_object(objects_.value(i))) continue;
      const bool is_bared =
          std::ranges::find(options_.bared, objects_.key(i)) != options_.bared.end();
      if (is_bared || gone_.contains(objects_.key(i)))
        add_installations_of(RawNode(objects_.value(i), arrays_), ids);
    }
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (!RawNode::is_object(objects_.value(i))) continue;
      const RawNode object(objects_.value(i), arrays_);
      const auto children = ids_in(object, "children");
      const auto is_gone = [&](const std::string& child) { return gone_.contains(child); };
      const auto leaves = [&](const std::string& child) { return ids.contains(child); };
      if (std::ranges::any_of(children, is_gone) && std::ranges::all_of(children, leaves) &&
          !building_of_.contains(objects_.key(i)))
        ids.insert(objects_.key(i));
    }
    return ids;
  }

  /// Drops the vertices that nothing uses any more and writes the new numbers everywhere.
  void exchange_vertices() {
    for (std::size_t i = 0; i < objects_.size(); ++i)
      if (!objects_.is_erased(i)) pool_->mark_used(objects_.value(i));
    pool_->renumber();
    for (std::size_t i = 0; i < objects_.size(); ++i)
      objects_.set(i, pool_->renumbered(objects_.value(i)));
    root_.set("vertices", pool_->text());
    pool_.reset();
    if (digits_ == 0) return;
    const Vec3 scale = source_.transform.scale;
    std::string text;
    append_json_array(text, std::array{detail::scaled_down(scale.x, digits_),
                                       detail::scaled_down(scale.y, digits_),
                                       detail::scaled_down(scale.z, digits_)});
    RawNode transform(root_.value_of("transform"));
    transform.set("scale", std::move(text));
    root_.set("transform", transform.text());
  }

  const WriteOptions& options_;
  bool is_finished_ = false, is_nothing_ = false;
  std::unordered_set<std::string> gone_;
  std::unordered_set<std::string> emptied_;
  /// Installations of solids that were replaced.
  std::unordered_set<std::string> outdated_;
  std::shared_ptr<const CityJsonSource> source_owner_;
  const CityJsonSource& source_;
  const Document& document_;
  /// Slices of the source's text that are long, for RawNode.
  std::vector<std::string_view> arrays_;
  RawNode root_;
  RawNode objects_;
  /// Buildings whose chosen geometry was replaced by one with a level of detail of its own.
  std::unordered_set<std::string> has_place_;
  /// Objects that have lost a geometry to the building that they stand on.
  std::unordered_set<std::size_t> has_dropped_;
  /// Indices into Document::buildings by id.
  std::unordered_map<std::string_view, std::size_t> building_of_;
  /// Members of `objects_` by id, made when the first is looked for.
  std::unordered_map<std::string, std::size_t> object_of_;
  std::optional<detail::FileVertices> pool_;
  /// By how many powers of ten the file's scale gets finer.
  int digits_ = 0;
};

CityJsonText::CityJsonText(const Document& document, const WriteOptions& options) {
  auto source = document.source;
  if (!source && document.format == Format::citygml) return;
  if (!source)
    source = std::make_shared<const CityJsonSource>(detail::fresh_cityjson(document.buildings));
  state_ = std::make_unique<State>(std::move(source), document, options);
}

CityJsonText::~CityJsonText() = default;
CityJsonText::CityJsonText(CityJsonText&&) noexcept = default;
CityJsonText& CityJsonText::operator=(CityJsonText&&) noexcept = default;

void CityJsonText::add(const LabelledBuilding& labelled) {
  if (state_) state_->relabel(labelled);
}

void CityJsonText::finish() {
  if (state_) state_->finish();
}

std::string CityJsonText::text() {
  finish();
  if (!state_ || state_->is_nothing()) return {};
  std::string text(state_->head());
  state_->root().append_text(text);
  return text += state_->tail();
}

void CityJsonText::write(const std::function<void(std::string_view)>& sink) {
  finish();
  if (!state_ || state_->is_nothing()) return;
  sink(state_->head());
  state_->root().write(sink);
  sink(state_->tail());
}

std::string write_cityjson(const Document& document, const std::vector<LabelledBuilding>& labelled,
                           const WriteOptions& options) {
  CityJsonText text(document, options);
  for (const LabelledBuilding& building : labelled) text.add(building);
  return text.text();
}

}  // namespace oriel
