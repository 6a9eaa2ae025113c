#include "io/cityjson/cityjson_objects.h"

#include "io/cityjson/lod_name.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

std::vector<std::size_t> families_of(const std::vector<Relative>& members) {
  std::vector<std::size_t> root(members.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto root_of = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::unordered_map<std::string_view, std::size_t> number_of;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (members[i].is_building) number_of.try_emplace(members[i].id, i);
  for (std::size_t i = 0; i < members.size(); ++i)
    for (const std::string_view id : members[i].relatives)
      if (const auto found = number_of.find(id); found != number_of.end()) {
        const std::size_t a = root_of(i);
        const std::size_t b = root_of(found->second);
        root[std::max(a, b)] = std::min(a, b);
      }
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = root_of(i);
  return root;
}

namespace {

/// Reads one element of "geometry" into `entry`; says what is wrong.
std::optional<Fault> list_geometry(dom::element element, std::size_t number, bool has_number_lods,
                                   ObjectEntry& entry) {
  const auto object = as_object(element);
  const auto type = object ? as_string(member(*object, "type")) : std::nullopt;
  if (!type)
    return Fault{Code::E202,
                 fmt::format("geometry {} is not an object with the text 'type'", number)};
  if (*type == "GeometryInstance") entry.has_instances = true;
  if (*type == "GeometryInstance" || *type == "MultiPoint" || *type == "MultiLineString")
    return std::nullopt;
  const auto kind = kind_of_geometry(*type);
  if (!kind)
    return Fault{Code::E204,
                 fmt::format("geometry {} has the unknown type {}; expected Solid, "
                             "MultiSolid, CompositeSolid, MultiSurface or CompositeSurface",
                             number, in_quotes(*type))};
  const auto lod = member(*object, "lod");
  if (!lod) return Fault{Code::E201, fmt::format("geometry {} has no 'lod'", number)};
  const bool is_number = has_number_lods && lod->is_number();
  if (!lod->is_string() && !is_number)
    return Fault{Code::E202, fmt::format("the 'lod' of geometry {} is {}; expected a text such as "
                                         "\"2.2\"",
                                         number, found_kind(lod))};
  entry.geometries.push_back(
      {number, *kind, is_number ? lod_name(simdjson::minify(*lod)) : std::string(*as_string(lod))});
  return std::nullopt;
}

std::optional<Fault> list_geometries(dom::object object, bool has_number_lods, ObjectEntry& entry) {
  const auto geometry = member(object, "geometry");
  if (!geometry) return std::nullopt;
  const auto elements = as_array(geometry);
  if (!elements)
    return Fault{Code::E202,
                 fmt::format("'geometry' is {}; expected an array", found_kind(geometry))};
  std::size_t number = 0;
  for (const dom::element element : *elements)
    if (auto fault = list_geometry(element, number++, has_number_lods, entry)) return fault;
  return std::nullopt;
}

void list_relatives(dom::object object, ObjectEntry& entry) {
  for (const std::string_view key : {"parents", "children"}) {
    const auto ids = as_array(member(object, key));
    if (!ids) continue;
    for (const dom::element id : *ids)
      if (const auto text = as_string(id)) entry.relatives.emplace_back(*text);
  }
}

/// Of what is written with WriteOptions::emptied.
std::optional<std::string> emptied_lod_of(dom::object object) {
  const auto attributes = as_object(member(object, "attributes"));
  if (!attributes || !member(*attributes, "oriel_member_of")) return std::nullopt;
  const auto lod = as_string(member(*attributes, "oriel_member_lod"));
  return std::string(lod.value_or(std::string_view()));
}

/// Orders lods by number ("0" < "1.2" < "2" < "2.2"), then by text.
bool is_lower(std::string_view a, std::string_view b) {
  const auto key = [](std::string_view lod) {
    double number = -1;
    std::from_chars(lod.data(), lod.data() + lod.size(), number);
    return std::pair(number, lod);
  };
  return key(a) < key(b);
}

/// What is known of a family before a geometry is chosen.
struct Family {
  std::set<std::string_view, decltype(&is_lower)> lods{&is_lower};
  bool was_reported = false;
};

template <class Lods>
std::string list_of(const Lods& lods) {
  std::string text;
  for (const std::string_view lod : lods) text += (text.empty() ? "" : ", ") + std::string(lod);
  return text;
}

GeometryChoice choose(const ObjectEntry& entry, Family& family,
                      const std::optional<std::string>& lod) {
  if (entry.fault) return {nullptr, entry.fault, Severity::error};
  if (entry.emptied_lod && (!lod || *lod == *entry.emptied_lod || entry.geometries.empty()))
    return {};
  if (!entry.is_building && (family.lods.empty() || (lod && !family.lods.contains(*lod))))
    return {};
  if (family.lods.empty()) {
    if (std::exchange(family.was_reported, true)) return {};
    return {nullptr,
            Fault{Code::E209, entry.has_instances ? "has template geometry only, which is not read"
                                                  : "has no geometry"},
            Severity::warning};
  }
  const bool is_there = !lod || family.lods.contains(*lod);
  const std::string_view chosen = lod ? std::string_view(*lod) : *family.lods.rbegin();
  if (const GeometryEntry* geometry = geometry_at(entry, chosen)) return {geometry, {}, {}};
  if (!is_there && !std::exchange(family.was_reported, true))
    return {nullptr,
            Fault{Code::E205, fmt::format("has no geometry at lod {}; it has {}", chosen,
                                          list_of(family.lods))},
            Severity::error};
  if (!is_there || entry.geometries.empty()) return {};
  return {
      nullptr,
      Fault{Code::E205, fmt::format("has no geometry at lod {}, which its family has; it is not "
                                    "labelled",
                                    chosen)},
      Severity::note};
}

/// True for an installation that has nothing of its own.
bool shares_geometry(dom::object object) {
  const auto attributes = as_object(member(object, "attributes"));
  return attributes && member(*attributes, "oriel_geometry").has_value();
}

}  // namespace

const GeometryEntry* geometry_at(const ObjectEntry& entry, std::string_view lod) {
  const GeometryEntry* surfaces = nullptr;
  for (const GeometryEntry& geometry : entry.geometries) {
    if (geometry.lod != lod) continue;
    if (geometry.kind.is_solid) return &geometry;
    if (surfaces == nullptr) surfaces = &geometry;
  }
  return surfaces;
}

std::vector<InstallationEntry> ObjectList::take_installations() {
  std::unordered_map<std::string_view, std::size_t> entry_of, parent_of;
  for (std::size_t i = 0; i < entries_.size() && !installations_.empty(); ++i) {
    entry_of.try_emplace(entries_[i].id, i);
    for (const std::string& id : entries_[i].relatives) parent_of.try_emplace(id, i);
  }
  for (InstallationEntry& entry : installations_) {
    entry.host = entries_.size();
    for (const std::string& id : entry.object.relatives)
      if (const auto found = entry_of.find(id); found != entry_of.end())
        entry.host = std::min(entry.host, found->second);
    if (const auto found = parent_of.find(entry.object.id); found != parent_of.end())
      entry.host = std::min(entry.host, found->second);
  }
  std::erase_if(installations_,
                [&](const InstallationEntry& entry) { return entry.host == entries_.size(); });
  std::ranges::stable_sort(installations_, {}, &InstallationEntry::host);
  return std::move(installations_);
}

std::vector<std::size_t> families_of(const std::vector<ObjectEntry>& entries) {
  std::vector<Relative> members;
  members.reserve(entries.size());
  for (const ObjectEntry& entry : entries)
    members.push_back(
        {entry.id, {entry.relatives.begin(), entry.relatives.end()}, entry.is_building});
  return families_of(members);
}

bool ObjectList::add(std::size_t number, std::string_view id, dom::element member) {
  ObjectEntry entry{number, id, {}, {}, {}, false};
  const auto object = as_object(member);
  const auto type = object ? as_string(detail::member(*object, "type")) : std::nullopt;
  if (!object)
    entry.fault = {Code::E202, fmt::format("is {}; expected a CityObject", found_kind(member))};
  else if (!type)
    entry.fault = {Code::E201, "has no 'type', or one that is not a text"};
  else if (entry.is_building = type == "Building" || type == "BuildingPart";
           !entry.is_building && listed_ == ListedObjects::buildings) {
    if (type != "BuildingInstallation" || shares_geometry(*object)) return false;
    list_relatives(*object, entry);
    entry.fault = list_geometries(*object, has_number_lods_, entry);
    installations_.push_back({std::move(entry), 0});
    return false;
  } else if (!ids_.insert(id).second)
    entry.fault = {Code::E207, "the id occurs twice in 'CityObjects'; the first one is read"};
  else
    entry.fault = list_geometries(*object, has_number_lods_, entry);
  if (object && entry.is_building) list_relatives(*object, entry);
  if (object) entry.emptied_lod = emptied_lod_of(*object);
  entries_.push_back(std::move(entry));
  return true;
}

const GeometryEntry* probable_geometry(const ObjectEntry& entry,
                                       const std::optional<std::string>& lod) {
  if (entry.fault || entry.emptied_lod || entry.geometries.empty()) return nullptr;
  return geometry_at(
      entry, lod ? *lod : std::ranges::max(entry.geometries, is_lower, &GeometryEntry::lod).lod);
}

std::vector<GeometryChoice> choose_geometries(const std::vector<ObjectEntry>& entries,
                                              const std::vector<std::size_t>& family_of,
                                              const std::optional<std::string>& lod) {
  std::vector<Family> families(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (const GeometryEntry& geometry : entries[i].geometries)
      families[family_of[i]].lods.insert(geometry.lod);
  std::vector<GeometryChoice> choices;
  for (std::size_t i = 0; i < entries.size(); ++i)
    choices.push_back(choose(entries[i], families[family_of[i]], lod));
  return choices;
}

}  // namespace oriel::detail
