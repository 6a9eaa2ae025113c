#pragma once

#include "io/cityjson/cityjson_geometry.h"
#include "io/json/dom.h"
#include "io/json/text.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace oriel::detail {

/// A member of "CityObjects" and those it names as parents or children.
struct Relative {
  std::string_view id;
  std::vector<std::string_view> relatives;
  /// Others than buildings are named by nobody.
  bool is_building = true;
};

/// The number of the family of each: connected by parents and children, directly or over others. It
/// is the number of the family's first member. Ids that nobody has connect nothing.
std::vector<std::size_t> families_of(const std::vector<Relative>& members);

/// A geometry that can be read: polygons of a solid or of surfaces.
struct GeometryEntry {
  /// Its number in the object's "geometry".
  std::size_t number = 0;
  GeometryKind kind;
  std::string lod;
};

/// A Building or BuildingPart of "CityObjects", or any other member with geometry.
struct ObjectEntry {
  /// Its number among all members of "CityObjects".
  std::size_t number = 0;
  std::string_view id;
  std::vector<GeometryEntry> geometries;
  /// Ids of its parents and children; none of an object that is no building.
  std::vector<std::string> relatives;
  /// Why it cannot be read.
  std::optional<Fault> fault;
  /// True if it has GeometryInstances, which are not read.
  bool has_instances = false;
  /// The level of detail that it has lost to a block of its series (`oriel_member_of`).
  std::optional<std::string> emptied_lod{};
  bool is_building = true;
};

/// A BuildingInstallation of "CityObjects" whose geometry is its own: not one that shares the
/// polygons of its building, as those do that oriel writes.
struct InstallationEntry {
  ObjectEntry object;
  /// The entry of the building or part that it stands on.
  std::size_t host = 0;
};

/// The same of entries.
std::vector<std::size_t> families_of(const std::vector<ObjectEntry>& entries);

/// What to do with an entry: the geometry to read, or a finding, or neither (no geometry, nothing
/// to say).
struct GeometryChoice {
  const GeometryEntry* geometry = nullptr;
  std::optional<Fault> finding;
  Severity severity = Severity::error;
};

/// Which members of "CityObjects" are listed.
enum class ListedObjects { buildings, all };

/// Lists members of "CityObjects", which come in the order of the file.
class ObjectList {
 public:
  /// Levels of detail may be numbers, as in CityJSON 1.0, if `has_number_lods`.
  ObjectList(bool has_number_lods, ListedObjects listed)
      : has_number_lods_(has_number_lods), listed_(listed) {}

  /// Takes the member number `number`. `id` must outlive the list. True if it is one of those
  /// listed, and the last of `entries` now.
  bool add(std::size_t number, std::string_view id, dom::element member);

  /// The buildings and parts, or all members. Members that are no CityObjects come too, with their
  /// fault (E201, E202); an id that stands twice has the fault E207.
  [[nodiscard]] const std::vector<ObjectEntry>& entries() const { return entries_; }

  /// The installations that stand on one of `entries`, its child or with it as a parent: in the
  /// order of their hosts, those of one host in the order of the file. To be asked for once, when
  /// all members are there; none unless only buildings are listed.
  [[nodiscard]] std::vector<InstallationEntry> take_installations();

 private:
  bool has_number_lods_;
  ListedObjects listed_;
  std::vector<ObjectEntry> entries_;
  std::unordered_set<std::string_view> ids_;
  std::vector<InstallationEntry> installations_;
};

/// The geometry of an entry at that level of detail: the first solid, else the first surfaces; null
/// if there is none.
const GeometryEntry* geometry_at(const ObjectEntry& entry, std::string_view lod);

/// The geometry that choose_geometries() gives unless others of its family have a say: at `lod`, or
/// at the highest level of the entry. Null if there is none.
const GeometryEntry* probable_geometry(const ObjectEntry& entry,
                                       const std::optional<std::string>& lod);

/// The geometry to read of each entry, parallel to `entries` and their families: that of the level
/// of detail `lod`, or of the highest one in the family (objects linked by parents and children); a
/// solid before surfaces. Without one: an error for the family that has none at the lod asked for
/// (E205), a note for a member of a family that has it elsewhere, a warning for a family without
/// any geometry (E209); of other objects than buildings nothing is said. Entries with a fault get
/// that. One that has lost the level to a block gets nothing, whatever other levels it has, unless
/// one of these is asked for.
std::vector<GeometryChoice> choose_geometries(const std::vector<ObjectEntry>& entries,
                                              const std::vector<std::size_t>& family_of,
                                              const std::optional<std::string>& lod);

}  // namespace oriel::detail
