#include "io/json/raw_json.h"
#include "kernel/base/text/json_text.h"
#include "oriel/energy.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel {

namespace {

/// O. Tufan, "Development and Testing of the CityJSON Energy Extension for Space Heating Demand
/// Calculation", TU Delft 2022; its file says version 1.1.0, of which a CityJSON file states two
/// numbers.
constexpr std::string_view kName = "Energy";
constexpr std::string_view kDeclaration =
    R"({"url":"https://raw.githubusercontent.com/ozgetufan/cjenergy/master/schemas/extensions/energy.ext.json","version":"1.1"})";
/// An attribute of buildings.
constexpr std::string_view kVolume = "+energy-volume";

std::string as_json(std::string_view text) {
  std::string out;
  append_json(out, text);
  return out;
}

std::string list_of(const std::vector<std::string>& ids) {
  std::string out;
  append_json_array(out, std::vector<std::string_view>(ids.begin(), ids.end()));
  return out;
}

std::string gross_volume(double volume_m3) {
  std::string out = R"([{"energy-type":"grossVolume","energy-value":)";
  append_json(out, volume_m3);
  return out + "}]";
}

/// The type of a boundary; empty: the extension has none for it.
std::string_view boundary_type(EnvelopeKind kind) {
  switch (kind) {
    case EnvelopeKind::wall:
      return "outerWall";
    case EnvelopeKind::roof:
    case EnvelopeKind::floor:
      return "roof";
    case EnvelopeKind::ground:
      return "groundSlab";
    case EnvelopeKind::ceiling:
      break;
  }
  return {};
}

/// Objects of the extension: their ids and texts.
using EnergyObjects = std::vector<std::pair<std::string, std::string>>;

/// Everything of one building.
class ZoneWriter {
 public:
  explicit ZoneWriter(const BuildingEnergy& of) : of_(of), zone_(of.building + kZone.data()) {}

  /// The id of an object is that of a zone of some buildings, or begins with it.
  static bool is_of_any(const std::string& id, const std::unordered_set<std::string>& buildings) {
    for (std::size_t end = id.find(kZone); end != id.npos; end = id.find(kZone, end + 1))
      if (buildings.contains(id.substr(0, end))) return true;
    return false;
  }

  EnergyObjects objects() {
    for (std::size_t i = 0; i < of_.faces.size(); ++i) {
      const EnvelopeFace& face = of_.faces[i];
      const std::string id = fmt::format("{}-{}", zone_, i + 1);
      const std::string_view type = boundary_type(face.kind);
      if (type.empty()) continue;
      if (face.exposed_m2() > kLeast_m2) add_boundary(id, type, face, face.exposed_m2(), true);
      const double party = face.party_m2.value_or(0);
      if (party > kLeast_m2) add_boundary(id + "-shared", "sharedWall", face, party, false);
    }
    std::string zone = R"({"type":"+Energy-ThermalZone","attributes":{"energy-volume":)";
    zone += gross_volume(of_.volume_m3) + R"(},"parents":)" + list_of({of_.building}) +
            R"(,"energy-boundedBy":)" + list_of(boundaries_) + "}";
    objects_.emplace(objects_.begin(), zone_, std::move(zone));
    return std::move(objects_);
  }

  [[nodiscard]] const std::string& zone() const { return zone_; }

 private:
  static constexpr std::string_view kZone = "-energy-zone";
  /// What is left of a face by rounding is no face.
  static constexpr double kLeast_m2 = 1e-4;

  void add_boundary(const std::string& id, std::string_view type, const EnvelopeFace& face,
                    double area_m2, bool has_openings) {
    std::vector<std::string> openings;
    double window_m2 = 0;
    for (const EnvelopeOpening& opening : face.openings) {
      if (!has_openings) break;
      openings.push_back(fmt::format("{}-{}", zone_, opening.id));
      if (!opening.is_door) window_m2 += opening.area_m2;
      std::string text = R"({"type":"+Energy-ThermalOpening","attributes":{"energy-area":)";
      append_json(text, opening.area_m2);
      objects_.emplace_back(openings.back(), text + "}}");
    }
    std::string text = R"({"type":"+Energy-ThermalBoundary","attributes":{)";
    append_json_key(text, "energy-thermalBoundaryType");
    append_json(text, type);
    append_json_key(text, "energy-azimuth");
    if (face.azimuth_deg)
      append_json(text, *face.azimuth_deg);
    else
      text += "null";
    append_field(text, "energy-inclination", face.inclination_deg);
    append_field(text, "energy-area", area_m2);
    if (has_openings) append_field(text, "energy-windowRatio", window_m2 / area_m2);
    text += R"(},"energy-delimits":)" + list_of({zone_});
    if (!openings.empty()) text += R"(,"energy-contains":)" + list_of(openings);
    objects_.emplace_back(id, text + "}");
    boundaries_.push_back(id);
  }

  const BuildingEnergy& of_;
  std::string zone_;
  std::vector<std::string> boundaries_;
  EnergyObjects objects_;
};

bool has_type(const RawNode& object, std::string_view prefix) {
  return decoded(object.value_of("type")).starts_with(prefix);
}

/// Takes out what an earlier call made of some buildings.
void erase_earlier(RawNode& objects, const std::vector<BuildingEnergy>& of) {
  std::unordered_set<std::string> buildings;
  for (const BuildingEnergy& one : of) buildings.insert(one.building);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects.is_erased(i) || !RawNode::is_object(objects.value(i))) continue;
    if (ZoneWriter::is_of_any(objects.key(i), buildings) &&
        has_type(RawNode(objects.value(i)), "+Energy-Thermal"))
      objects.erase(i);
  }
}

/// Among some children; their number if it is not there.
std::size_t place_of_child(const RawNode& children, const std::string& id) {
  std::size_t i = 0;
  while (i < children.size() && decoded(children.value(i)) != id) ++i;
  return i;
}

/// The building with its volume and its zone among its children.
std::string with_zone(std::string_view text, const BuildingEnergy& of, const std::string& zone) {
  RawNode object(text);
  const std::string_view there = object.value_of("attributes");
  RawNode attributes(RawNode::is_object(there) ? there : "{}");
  attributes.set(kVolume, gross_volume(of.volume_m3));
  object.set("attributes", attributes.text());
  const std::string_view ids = object.value_of("children");
  RawNode children(RawNode::is_array(ids) ? ids : "[]");
  if (place_of_child(children, zone) == children.size()) children.push_back(as_json(zone));
  object.set("children", children.text());
  return object.text();
}

/// The building without what with_zone() gave it.
std::string without_zone(std::string_view text, const std::string& zone) {
  RawNode object(text);
  const std::string_view there = object.value_of("attributes"), ids = object.value_of("children");
  if (RawNode::is_object(there)) {
    RawNode attributes(there);
    attributes.erase(kVolume);
    object.set("attributes", attributes.text());
  }
  if (!RawNode::is_array(ids)) return object.text();
  RawNode children(ids);
  const std::size_t place = place_of_child(children, zone);
  if (place == children.size()) return object.text();
  children.erase(place);
  if (children.size() > 1)
    object.set("children", children.text());
  else
    object.erase("children");
  return object.text();
}

}  // namespace

std::string with_energy_extension(const std::string& text, const std::vector<BuildingEnergy>& of) {
  const std::size_t start = text.find('{');
  if (start == std::string::npos) return text;
  const std::size_t end = text.rfind('}') + 1;
  RawNode root(std::string_view(text).substr(start, end - start));
  if (decoded(root.value_of("type")) == "CityJSON") {
    const std::string_view there = root.value_of("extensions");
    RawNode extensions(RawNode::is_object(there) ? there : "{}");
    extensions.set(kName, std::string(kDeclaration));
    root.set("extensions", extensions.text());
  }
  const std::string_view objects_text = root.value_of("CityObjects");
  if (!of.empty() && RawNode::is_object(objects_text)) {
    RawNode objects(objects_text);
    erase_earlier(objects, of);
    std::unordered_map<std::string, std::size_t> place_of;
    for (std::size_t i = 0; i < objects.size(); ++i)
      if (!objects.is_erased(i)) place_of.try_emplace(objects.key(i), i);
    for (const BuildingEnergy& one : of) {
      const auto place = place_of.find(one.building);
      if (place == place_of.end()) continue;
      ZoneWriter writer(one);
      if (!one.is_known) {
        objects.set(place->second, without_zone(objects.value(place->second), writer.zone()));
        continue;
      }
      objects.set(place->second, with_zone(objects.value(place->second), one, writer.zone()));
      for (auto& [id, object] : writer.objects()) objects.append(id, std::move(object));
    }
    root.set("CityObjects", objects.text());
  }
  std::string out = text.substr(0, start);
  root.append_text(out);
  return out + text.substr(end);
}

}  // namespace oriel
