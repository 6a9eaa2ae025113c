#include "io/citygml/write/citygml_writer.h"

#include "io/citygml/write/gml_attributes.h"
#include "io/citygml/write/gml_levels.h"
#include "io/citygml/write/xml_text.h"
#include "io/objects/city_record.h"
#include "io/objects/closed_installations.h"
#include "kernel/base/index.h"
#include "kernel/base/text/json_text.h"
#include "kernel/base/text/xml.h"
#include "model/labelled_building.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace detail {

namespace {

using PolygonRings = std::vector<std::vector<int>>;

/// Where a polygon of a geometry is written.
struct PolygonPlace {
  std::string id;
  /// The surface that it is written in, or -1: where it is used.
  int surface = -1;
  /// Another object has written it.
  bool is_elsewhere = false;
};

constexpr std::string_view kStart2 =
    R"(<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:gen="http://www.opengis.net/citygml/generics/2.0" xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink">
)";
constexpr std::string_view kStart3 =
    R"(<core:CityModel gml:id="oriel.model" xmlns:core="http://www.opengis.net/citygml/3.0" xmlns:bldg="http://www.opengis.net/citygml/building/3.0" xmlns:con="http://www.opengis.net/citygml/construction/3.0" xmlns:gen="http://www.opengis.net/citygml/generics/3.0" xmlns:gml="http://www.opengis.net/gml/3.2" xmlns:xlink="http://www.w3.org/1999/xlink">
)";

/// "https://www.opengis.net/def/crs/EPSG/0/25832" as each version has it.
std::string srs_name(const std::string& crs, GmlVersion version) {
  constexpr std::string_view kMark = "/def/crs/EPSG/";
  const std::size_t at = crs.find(kMark);
  if (at == std::string::npos) return crs;
  const std::string code = crs.substr(crs.rfind('/') + 1);
  return version == GmlVersion::two ? "urn:ogc:def:crs:EPSG::" + code
                                    : "http://www.opengis.net/def/crs/EPSG/0/" + code;
}

class GmlWriter {
 public:
  GmlWriter(const CityRecord& record, GmlVersion version, std::string crs)
      : record_(record), version_(version), crs_(srs_name(crs, version)), levels_(record, version) {
    for (std::size_t i = 0; i < record.objects.size(); ++i)
      number_of_.try_emplace(record.objects[i].id, i);
    for (const CityObject& object : record.objects)
      if (is_installation(object)) note_shared(object);
  }

  std::string members() {
    for (std::size_t i = 0; i < record_.objects.size(); ++i) {
      const CityObject& object = record_.objects[i];
      if (!is_building(object) || !object.parents.empty()) continue;
      out_ += "<core:cityObjectMember>\n";
      write_object(i, "bldg:Building", true);
      out_ += "</core:cityObjectMember>\n";
    }
    return std::move(out_);
  }

  /// How many objects members() has not written, by type.
  [[nodiscard]] std::map<std::string, int> left_out() const {
    std::map<std::string, int> counts;
    for (std::size_t i = 0; i < record_.objects.size(); ++i)
      if (!written_.contains(i)) ++counts[record_.objects[i].type];
    return counts;
  }

 private:
  [[nodiscard]] bool is_two() const { return version_ == GmlVersion::two; }

  static bool is_building(const CityObject& object) {
    return object.type == "Building" || object.type == "BuildingPart";
  }
  static bool is_installation(const CityObject& object) {
    return object.type == "BuildingInstallation" || object.type == "BuildingConstructiveElement";
  }

  /// Polygons of installations: what the building has of them is to be linked to.
  void note_shared(const CityObject& object) {
    for (const CityGeometry& geometry : object.geometries)
      for_each_city_polygon(geometry,
                            [&](const CityPolygon& polygon) { shared_.insert(polygon.rings); });
  }

  void line(std::string_view text) {
    out_ += text;
    out_ += '\n';
  }
  void open(std::string_view name) { line(std::string("<").append(name).append(">")); }
  void close(std::string_view name) { line(std::string("</").append(name).append(">")); }

  /// An id that no other thing in the file has; version 3.0 wants one for each.
  std::string made_id() {
    return std::string(kMadeId).append(xml_id(top_)) + '.' + std::to_string(made_++);
  }
  std::string made_id_attribute() { return is_two() ? "" : " gml:id=\"" + made_id() + '"'; }

  void write_object(std::size_t number, std::string_view element, bool is_top) {
    if (!written_.insert(number).second) return;
    const CityObject& object = record_.objects[number];
    if (is_top) {
      top_ = object.id;
      made_ = 0;
      used_ids_.clear();
      place_of_.clear();
    }
    const std::string id = xml_id(object.id);
    used_ids_.insert(id);
    const GmlAttributes attributes =
        gml_attributes(object.attributes, version_,
                       is_building(object) ? GmlOwner::building : GmlOwner::installation,
                       id == object.id ? "" : object.id);
    line(std::string("<").append(element) + " gml:id=\"" + id + "\">");
    out_ += attributes.names;
    if (is_top) write_envelope(number);
    out_ += attributes.generic;
    if (is_two())
      write_rest_2(number, attributes);
    else
      write_rest_3(number, attributes);
    close(element);
  }

  void write_rest_2(std::size_t number, const GmlAttributes& attributes) {
    const CityObject& object = record_.objects[number];
    out_ += attributes.building;
    const auto places = places_of(number);
    if (!is_building(object)) {
      for (const auto& [lod, level] : levels_.of(number))
        write_geometries(lod, level, places, "Geometry", "Geometry");
      return write_boundaries(number, places);
    }
    const auto write_levels = [&](char from, char to) {
      for (const auto& [lod, level] : levels_.of(number)) {
        if (lod < from || lod > to) continue;
        write_geometries(lod, level, places, "Solid", lod == '0' ? "FootPrint" : "MultiSurface");
      }
    };
    write_levels('0', '2');
    write_children(number, "bldg:outerBuildingInstallation", "BuildingInstallation");
    write_children(number, "bldg:outerBuildingInstallation", "BuildingConstructiveElement");
    write_boundaries(number, places);
    write_levels('3', '3');
    write_children(number, "bldg:consistsOfBuildingPart", "BuildingPart");
  }

  void write_rest_3(std::size_t number, const GmlAttributes& attributes) {
    const auto places = places_of(number);
    write_boundaries(number, places);
    for (const auto& [lod, level] : levels_.of(number))
      write_geometries(lod, level, places, "Solid", "MultiSurface");
    out_ += attributes.construction + attributes.building;
    write_children(number, "bldg:buildingConstructiveElement", "BuildingConstructiveElement");
    write_children(number, "bldg:buildingInstallation", "BuildingInstallation");
    write_children(number, "bldg:buildingPart", "BuildingPart");
  }

  void write_children(std::size_t number, std::string_view property, std::string_view type) {
    for (const std::string& id : record_.objects[number].children) {
      const std::size_t child = number_of_.at(id);
      if (record_.objects[child].type != type || written_.contains(child)) continue;
      const bool becomes_installation = is_two() && type == "BuildingConstructiveElement";
      open(property);
      write_object(
          child, std::string("bldg:").append(becomes_installation ? "BuildingInstallation" : type),
          false);
      close(property);
    }
  }

  /// Those of a building and all that belongs to it.
  void grow(std::size_t number, Box& box, std::set<std::size_t>& met) const {
    if (!met.insert(number).second) return;
    const CityObject& object = record_.objects[number];
    for (const CityGeometry& geometry : object.geometries)
      for_each_city_polygon(geometry, [&](const CityPolygon& polygon) {
        for (const int v : polygon.rings[0]) box.grow(record_.vertices[at(v)]);
      });
    for (const std::string& child : object.children) grow(number_of_.at(child), box, met);
  }

  void write_envelope(std::size_t number) {
    Box box;
    std::set<std::size_t> met;
    grow(number, box, met);
    if (box.is_empty()) return;
    out_ += "<gml:boundedBy><gml:Envelope";
    if (!crs_.empty()) {
      out_ += " srsName=\"";
      out_ += escaped_xml(crs_);
      out_ += '"';
    }
    out_ += " srsDimension=\"3\"><gml:lowerCorner>";
    append_point(box.min);
    out_ += "</gml:lowerCorner><gml:upperCorner>";
    append_point(box.max);
    line("</gml:upperCorner></gml:Envelope></gml:boundedBy>");
  }

  void append_point(Vec3 p) { out_ += shortest(p.x) + ' ' + shortest(p.y) + ' ' + shortest(p.z); }

  using Places = std::map<const CityGeometry*, std::vector<PolygonPlace>>;

  /// Where the polygons of an object are written, in reading order of each geometry.
  Places places_of(std::size_t number) {
    Places places;
    for (const auto& [lod, level] : levels_.of(number))
      for (const CityGeometry* geometry : {level.solid, level.surfaces})
        if (geometry != nullptr) places[geometry] = places_in(*geometry, lod);
    return places;
  }

  std::vector<PolygonPlace> places_in(const CityGeometry& geometry, char lod) {
    std::vector<PolygonPlace> places;
    const std::vector<int> surfaces = levels_.surfaces_of(geometry, lod);
    for_each_city_polygon(geometry, [&](const CityPolygon& polygon) {
      PolygonPlace place{"", surfaces[places.size()]};
      const bool is_shared = shared_.contains(polygon.rings);
      if (is_shared)
        if (const auto found = place_of_.find({lod, polygon.rings}); found != place_of_.end())
          place = {found->second, place.surface, true};
      if (place.id.empty() && (place.surface >= 0 || is_shared || !is_two())) place.id = made_id();
      if (is_shared) place_of_.try_emplace({lod, polygon.rings}, place.id);
      places.push_back(std::move(place));
    });
    return places;
  }

  /// The polygon itself, or a link to it.
  void write_member(const CityPolygon& polygon, const PolygonPlace& place, bool is_link) {
    if (is_link || place.is_elsewhere) {
      line("<gml:surfaceMember xlink:href=\"#" + place.id + "\"/>");
      return;
    }
    out_ += "<gml:surfaceMember><gml:Polygon";
    if (!place.id.empty()) out_ += " gml:id=\"" + place.id + '"';
    out_ += '>';
    for (const auto& ring : polygon.rings) {
      const std::string_view name = &ring == polygon.rings.data() ? "exterior" : "interior";
      out_ +=
          std::string("<gml:").append(name) + "><gml:LinearRing><gml:posList srsDimension=\"3\">";
      for (const int v : ring) {
        append_point(record_.vertices[at(v)]);
        out_ += ' ';
      }
      append_point(record_.vertices[at(ring.front())]);
      out_ += std::string("</gml:posList></gml:LinearRing></gml:").append(name) + '>';
    }
    line("</gml:Polygon></gml:surfaceMember>");
  }

  [[nodiscard]] std::string level_property(char lod, std::string_view what) const {
    return (is_two() ? "bldg:lod" : "core:lod") + std::string(1, lod) + std::string(what);
  }

  void write_geometries(char lod, const GmlLevel& level, const Places& places,
                        std::string_view solid_kind, std::string_view surface_kind) {
    if (level.solid != nullptr) {
      // Level 0 has no solids, in any version.
      if (lod == '0')
        write_surfaces(level_property(lod, is_two() ? "FootPrint" : "MultiSurface"), *level.solid,
                       places.at(level.solid));
      else
        write_solid(level_property(lod, solid_kind), *level.solid, places.at(level.solid));
    }
    const bool is_second = level.solid != nullptr && (lod == '0' || solid_kind == surface_kind);
    // Of 3.0, level 1 has surfaces as boundaries only.
    const bool has_property = is_two() || lod != '1';
    if (level.surfaces != nullptr && !is_second && has_property)
      write_surfaces(level_property(lod, surface_kind), *level.surfaces, places.at(level.surfaces));
  }

  void write_surfaces(const std::string& property, const CityGeometry& geometry,
                      const std::vector<PolygonPlace>& places) {
    if (places.empty()) return;
    open(property);
    line("<gml:MultiSurface" + made_id_attribute() + '>');
    std::size_t next = 0;
    for_each_city_polygon(geometry, [&](const CityPolygon& polygon) {
      const PolygonPlace& place = places[next++];
      write_member(polygon, place, place.surface >= 0);
    });
    close("gml:MultiSurface");
    close(property);
  }

  void write_solid(const std::string& property, const CityGeometry& geometry,
                   const std::vector<PolygonPlace>& places) {
    if (places.empty()) return;
    open(property);
    const bool has_many = geometry.bodies.size() > 1;
    if (has_many) line("<gml:CompositeSolid" + made_id_attribute() + '>');
    std::size_t next = 0;
    for (const auto& shells : geometry.bodies) {
      if (has_many) open("gml:solidMember");
      line("<gml:Solid" + made_id_attribute() + '>');
      for (const auto& shell : shells) {
        if (shell.empty()) continue;
        const std::string_view side = &shell == shells.data() ? "gml:exterior" : "gml:interior";
        const std::string_view kind = is_two() ? "gml:CompositeSurface" : "gml:Shell";
        line(std::string("<").append(side) + "><" + std::string(kind) +
             (is_two() ? "" : made_id_attribute()) + '>');
        for (const CityPolygon& polygon : shell) {
          const PolygonPlace& place = places[next++];
          write_member(polygon, place, place.surface >= 0);
        }
        line(std::string("</").append(kind) + "></" + std::string(side) + '>');
      }
      close("gml:Solid");
      if (has_many) close("gml:solidMember");
    }
    if (has_many) close("gml:CompositeSolid");
    close(property);
  }

  void write_boundaries(std::size_t number, const Places& places) {
    for (const auto& [lod, level] : levels_.of(number))
      for (const CityGeometry* geometry : {level.solid, level.surfaces}) {
        if (geometry == nullptr) continue;
        write_boundaries_of(*geometry, lod, places.at(geometry));
        if (!is_two() && lod == '1' && geometry == level.surfaces)
          write_nameless(*geometry, places.at(geometry));
      }
  }

  /// The polygons of each surface, with their places.
  using SurfacePolygons =
      std::vector<std::vector<std::pair<const CityPolygon*, const PolygonPlace*>>>;

  void write_boundaries_of(const CityGeometry& geometry, char lod,
                           const std::vector<PolygonPlace>& places) {
    SurfacePolygons polygons(geometry.surfaces.size());
    std::size_t next = 0;
    for_each_city_polygon(geometry, [&](const CityPolygon& polygon) {
      const PolygonPlace& place = places[next++];
      if (place.surface >= 0) polygons[at(place.surface)].emplace_back(&polygon, &place);
    });
    std::map<int, std::vector<int>> openings;  // by the surface that they lie in, -1: none
    for (std::size_t s = 0; s < geometry.surfaces.size(); ++s) {
      const auto& [type, parent, members] = geometry.surfaces[s];
      if (!is_opening_type(type) || polygons[s].empty()) continue;
      const bool has_parent = parent >= 0 && is_boundary(geometry.surfaces[at(parent)].type) &&
                              (is_two() || geometry.surfaces[at(parent)].type != "ClosureSurface");
      openings[has_parent ? parent : -1].push_back(static_cast<int>(s));
    }
    for (std::size_t s = 0; s < geometry.surfaces.size(); ++s) {
      const auto in_it = openings.find(static_cast<int>(s));
      if (!is_boundary(geometry.surfaces[s].type)) continue;
      if (polygons[s].empty() && in_it == openings.end()) continue;
      write_boundary(geometry, lod, polygons, static_cast<int>(s),
                     in_it == openings.end() ? std::vector<int>{} : in_it->second);
    }
    if (const auto homeless = openings.find(-1); homeless != openings.end())
      write_boundary(geometry, lod, polygons, -1, homeless->second);
  }

  [[nodiscard]] std::string surface_element(std::string_view type) const {
    const bool is_closure = type == "ClosureSurface";
    std::string name = is_two() ? "bldg:" : is_closure ? "core:" : "con:";
    name += type;
    if (!is_two() && is_opening_type(type)) name += "Surface";
    return name;
  }

  /// A boundary surface with the openings in it; surface -1 is a wall without polygons.
  void write_boundary(const CityGeometry& geometry, char lod, const SurfacePolygons& polygons,
                      int surface, const std::vector<int>& openings) {
    const std::string property = is_two() ? "bldg:boundedBy" : "core:boundary";
    const std::string element =
        surface_element(surface < 0 ? "WallSurface" : geometry.surfaces[at(surface)].type);
    open(property);
    open_surface(geometry, surface, element);
    if (surface >= 0) write_polygons(lod, polygons[at(surface)]);
    const std::string filling = is_two() ? "bldg:opening" : "con:fillingSurface";
    for (const int opening : openings) {
      const std::string inner = surface_element(geometry.surfaces[at(opening)].type);
      open(filling);
      open_surface(geometry, opening, inner);
      write_polygons(lod, polygons[at(opening)]);
      close(inner);
      close(filling);
    }
    close(element);
    close(property);
  }

  void open_surface(const CityGeometry& geometry, int surface, const std::string& element) {
    CityMembers members;
    std::string id, escaped;
    if (surface >= 0) {
      members = geometry.surfaces[at(surface)].members;
      const std::string own(member_text(members, "id"));
      if (!own.empty() && used_ids_.insert(xml_id(own)).second) {
        id = xml_id(own);
        if (id != own) escaped = own;
        std::erase_if(members, [](const auto& one) { return one.first == "id"; });
      }
    }
    if (id.empty() && !is_two()) id = made_id();
    line('<' + element + (id.empty() ? "" : " gml:id=\"" + id + '"') + '>');
    const GmlAttributes attributes = gml_attributes(members, version_, GmlOwner::surface, escaped);
    out_ += attributes.names + attributes.generic;
  }

  void write_polygons(
      char lod, const std::vector<std::pair<const CityPolygon*, const PolygonPlace*>>& polygons) {
    if (polygons.empty()) return;
    const std::string property = level_property(lod, "MultiSurface");
    open(property);
    line("<gml:MultiSurface" + made_id_attribute() + '>');
    for (const auto& [polygon, place] : polygons) write_member(*polygon, *place, false);
    close("gml:MultiSurface");
    close(property);
  }

  /// Surfaces of level 1 that have no type.
  void write_nameless(const CityGeometry& geometry, const std::vector<PolygonPlace>& places) {
    std::vector<std::pair<const CityPolygon*, const PolygonPlace*>> polygons;
    std::size_t next = 0;
    for_each_city_polygon(geometry, [&](const CityPolygon& polygon) {
      const PolygonPlace& place = places[next++];
      if (place.surface < 0) polygons.emplace_back(&polygon, &place);
    });
    if (polygons.empty()) return;
    open("core:boundary");
    line("<gen:GenericThematicSurface" + made_id_attribute() + '>');
    write_polygons('1', polygons);
    close("gen:GenericThematicSurface");
    close("core:boundary");
  }

  const CityRecord& record_;
  GmlVersion version_;
  std::string crs_;
  GmlRecordLevels levels_;
  std::map<std::string_view, std::size_t> number_of_;
  /// Polygons of installations.
  std::set<PolygonRings> shared_;
  std::string out_;
  std::set<std::size_t> written_;
  /// Of the building at hand: its id, how many ids were made, the ids of surfaces, and the shared
  /// polygons that are written, by level.
  std::string_view top_;
  int made_ = 0;
  std::set<std::string> used_ids_;
  std::map<std::pair<char, PolygonRings>, std::string> place_of_;
};

/// What is not in the file that the record had.
Issue left_out_warning(const std::map<std::string, int>& counts, const std::string& file) {
  std::vector<std::string> words;
  for (const auto& [type, count] : counts) words.push_back(fmt::format("{} {}", count, type));
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E168;
  issue.sentence = fmt::format("objects that oriel does not write as CityGML are left out: {}",
                               fmt::join(words, ", "));
  issue.place.file = file;
  return issue;
}

}  // namespace

}  // namespace detail

std::string citygml_text(std::string_view text, const Document& document, Format format,
                         bool closes_installations, std::vector<Issue>& issues) {
  if (text.empty()) return {};
  const auto version =
      format == Format::citygml3 ? detail::GmlVersion::three : detail::GmlVersion::two;
  const Transform transform = document.source ? document.source->transform : Transform{};
  detail::CityRecord record = detail::city_record(text, transform);
  if (closes_installations)
    for (Issue& issue : detail::close_installations(record)) issues.push_back(std::move(issue));
  std::string crs = record.crs;
  if (crs.empty() && !document.buildings.empty()) crs = document.buildings[0].frame.crs;
  std::string out;
  if (!record.is_feature) {
    out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
    out += version == detail::GmlVersion::two ? detail::kStart2 : detail::kStart3;
  }
  detail::GmlWriter writer(record, version, crs);
  out += writer.members();
  if (const auto counts = writer.left_out(); !counts.empty())
    issues.push_back(detail::left_out_warning(counts, document.name));
  return out;
}

std::string citygml_end() { return "</core:CityModel>\n"; }

}  // namespace oriel
