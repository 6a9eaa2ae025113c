#include "interpret/language/synonyms.h"

#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

using enum NameKind;

constexpr std::string_view kOfBoundary =
    "'silhouette' is a times b, 'new_area' the area of its opening or foot, 'surface' that of all "
    "its facets";
constexpr std::string_view kDepthOrRecess =
    "'depth' is along the normal of its wall; 'recess' is how far behind the wall it lies";
constexpr std::string_view kBaseHeight = "the height of its lowest point over the ground";
constexpr std::string_view kAboveEaves =
    "'above_eaves' is how far its bottom lies above the eaves of its roof or wall";
constexpr std::string_view kBelowRidge =
    "'below_ridge' is how far its top stays below the highest point of the roofs";
constexpr std::string_view kAlong = "of its middle, from the left end of its wall or roof";
constexpr std::string_view kAskForClass = "the label is asked for by 'self is CLASS'";
constexpr std::string_view kNoFeet = "a foot is 0.3048 m, an inch 2.54 cm";

constexpr std::array kNameSynonyms = {
    // CityGML, IFC, eCognition, QGIS and GRASS, and what people say.
    NameSynonym{attribute, "slope", "inclination", "0 deg is level, 90 deg a wall"},
    NameSynonym{attribute, "pitch", "inclination", "0 deg is level, 90 deg a wall"},
    NameSynonym{attribute, "tilt", "inclination", "0 deg is level, 90 deg a wall"},
    NameSynonym{attribute, "gradient", "inclination", "0 deg is level, 90 deg a wall"},
    NameSynonym{attribute, "steepness", "inclination", "0 deg is level, 90 deg a wall"},
    NameSynonym{attribute, "angle", "inclination", "0 deg is level, 90 deg a wall"},
    NameSynonym{attribute, "roof_slope", "host_inclination", "of the roof or wall it is on"},
    NameSynonym{attribute, "roof_pitch", "host_inclination", "of the roof or wall it is on"},
    NameSynonym{attribute, "wall_slope", "host_inclination", "of the roof or wall it is on"},
    NameSynonym{attribute, "host_slope", "host_inclination", "of the roof or wall it is on"},
    NameSynonym{attribute, "aspect", "azimuth", "clockwise from north"},
    NameSynonym{attribute, "orientation", "azimuth", "clockwise from north"},
    NameSynonym{attribute, "direction", "azimuth", "clockwise from north"},
    NameSynonym{attribute, "bearing", "azimuth", "clockwise from north"},
    NameSynonym{attribute, "heading", "azimuth", "clockwise from north"},
    NameSynonym{attribute, "exposure", "azimuth", "clockwise from north"},
    NameSynonym{attribute, "area", "silhouette", kOfBoundary},
    NameSynonym{attribute, "size", "silhouette", kOfBoundary},
    NameSynonym{attribute, "area_pxl", "silhouette", kOfBoundary},
    NameSynonym{attribute, "opening_area", "new_area"},
    NameSynonym{attribute, "footprint", "new_area"},
    NameSynonym{attribute, "footprint_area", "new_area"},
    NameSynonym{attribute, "cap_area", "new_area"},
    NameSynonym{attribute, "surface_area", "surface"},
    NameSynonym{attribute, "envelope_area", "surface"},
    NameSynonym{attribute, "shell_area", "surface"},
    NameSynonym{attribute, "cubature", "volume"},
    NameSynonym{attribute, "gross_volume", "volume"},
    NameSynonym{attribute, "net_volume", "volume"},
    NameSynonym{attribute, "thickness", "depth", kDepthOrRecess},
    NameSynonym{attribute, "overall_depth", "depth", kDepthOrRecess},
    NameSynonym{attribute, "reveal", "recess", kDepthOrRecess},
    NameSynonym{attribute, "setback", "recess", kDepthOrRecess},
    NameSynonym{attribute, "indentation", "recess", kDepthOrRecess},
    NameSynonym{attribute, "niche_depth", "recess", kDepthOrRecess},
    NameSynonym{attribute, "overhang", "growth_out"},
    NameSynonym{attribute, "projection", "growth_out"},
    NameSynonym{attribute, "protrusion", "growth_out",
                "whether it is one is asked for by 'sense = protrusion'"},
    NameSynonym{attribute, "sill", "base_height", kBaseHeight},
    NameSynonym{attribute, "sill_height", "base_height", kBaseHeight},
    NameSynonym{attribute, "parapet", "base_height", kBaseHeight},
    NameSynonym{attribute, "bottom", "base_height", kBaseHeight},
    NameSynonym{attribute, "base", "base_height", kBaseHeight},
    NameSynonym{attribute, "elevation", "base_height", kBaseHeight},
    NameSynonym{attribute, "altitude", "base_height", kBaseHeight},
    NameSynonym{attribute, "height_above_ground", "base_height", kBaseHeight},
    NameSynonym{attribute, "z", "base_height", kBaseHeight},
    NameSynonym{attribute, "z_min", "base_height", kBaseHeight},
    NameSynonym{attribute, "zmin", "base_height", kBaseHeight},
    NameSynonym{attribute, "min_z", "base_height", kBaseHeight},
    NameSynonym{attribute, "lintel", "top"},
    NameSynonym{attribute, "head_height", "top"},
    NameSynonym{attribute, "top_height", "top"},
    NameSynonym{attribute, "z_max", "top"},
    NameSynonym{attribute, "zmax", "top"},
    NameSynonym{attribute, "max_z", "top"},
    NameSynonym{attribute, "overall_height", "height"},
    NameSynonym{attribute, "measured_height", "height"},
    NameSynonym{attribute, "relative_height", "height"},
    NameSynonym{attribute, "overall_width", "width"},
    NameSynonym{attribute, "breadth", "width"},
    NameSynonym{attribute, "length", "a",
                "the longest edge of its box; 'b' and 'c' are the others"},
    NameSynonym{attribute, "longest", "a",
                "the longest edge of its box; 'b' and 'c' are the others"},
    NameSynonym{attribute, "shortest", "c", "the shortest edge of its box"},
    NameSynonym{attribute, "eaves_height", "", kAboveEaves},
    NameSynonym{attribute, "ridge_distance", "below_ridge"},
    NameSynonym{attribute, "ridge_height", "", kBelowRidge},
    NameSynonym{attribute, "margin", "edge_gap"},
    NameSynonym{attribute, "border_distance", "edge_gap"},
    NameSynonym{attribute, "distance_to_edge", "edge_gap"},
    NameSynonym{attribute, "x", "along", kAlong},
    NameSynonym{attribute, "position", "along", kAlong},
    NameSynonym{attribute, "floor", "storey", "from 0"},
    NameSynonym{attribute, "story", "storey", "from 0"},
    NameSynonym{attribute, "level", "storey", "from 0"},
    NameSynonym{attribute, "storey_number", "storey", "from 0"},
    NameSynonym{attribute, "floor_number", "storey", "from 0"},
    NameSynonym{attribute, "level_of_detail", "lod"},
    NameSynonym{attribute, "kind", "sense", "protrusion, hole, cavity or imprint"},
    NameSynonym{attribute, "type", "sense", "protrusion, hole, cavity or imprint"},
    NameSynonym{attribute, "shape", "sense", "protrusion, hole, cavity or imprint"},
    NameSynonym{attribute, "label", "", kAskForClass},
    NameSynonym{attribute, "class", "", kAskForClass},
    NameSynonym{attribute, "parent", "",
                "the host is asked for by 'host is CLASS' or exists(host ...)"},

    NameSynonym{surface_attribute, "slope", "inclination", "90 deg is a wall, 180 deg looks down"},
    NameSynonym{surface_attribute, "pitch", "inclination", "90 deg is a wall, 180 deg looks down"},
    NameSynonym{surface_attribute, "tilt", "inclination", "90 deg is a wall, 180 deg looks down"},
    NameSynonym{surface_attribute, "angle", "inclination", "90 deg is a wall, 180 deg looks down"},
    NameSynonym{surface_attribute, "normal", "inclination", "90 deg is a wall, 180 deg looks down"},
    NameSynonym{surface_attribute, "aspect", "azimuth", "clockwise from north"},
    NameSynonym{surface_attribute, "orientation", "azimuth", "clockwise from north"},
    NameSynonym{surface_attribute, "direction", "azimuth", "clockwise from north"},
    NameSynonym{surface_attribute, "size", "area"},
    NameSynonym{surface_attribute, "surface_area", "area"},
    NameSynonym{surface_attribute, "silhouette", "area"},
    NameSynonym{surface_attribute, "surface", "area"},
    NameSynonym{surface_attribute, "elevation", "base_height"},
    NameSynonym{surface_attribute, "altitude", "base_height"},
    NameSynonym{surface_attribute, "z", "base_height"},
    NameSynonym{surface_attribute, "z_min", "base_height"},
    NameSynonym{surface_attribute, "min_z", "base_height"},
    NameSynonym{surface_attribute, "z_max", "top"},
    NameSynonym{surface_attribute, "max_z", "top"},
    NameSynonym{surface_attribute, "width", "a", "its longer side; 'b' is the shorter one"},
    NameSynonym{surface_attribute, "length", "a", "its longer side; 'b' is the shorter one"},
    NameSynonym{surface_attribute, "depth", "b", "its shorter side; 'a' is the longer one"},
    NameSynonym{surface_attribute, "label", "part"},
    NameSynonym{surface_attribute, "class", "part"},
    NameSynonym{surface_attribute, "feature", "part"},

    NameSynonym{relation, "adjacent", "beside"},
    NameSynonym{relation, "adjacent_to", "beside"},
    NameSynonym{relation, "neighbour", "beside"},
    NameSynonym{relation, "neighbours", "beside"},
    NameSynonym{relation, "neighbor", "beside"},
    NameSynonym{relation, "neighbors", "beside"},
    NameSynonym{relation, "next_to", "beside"},
    NameSynonym{relation, "near", "beside"},
    NameSynonym{relation, "touches", "beside"},
    NameSynonym{relation, "border_to", "beside"},
    NameSynonym{relation, "rel_border_to", "beside"},
    NameSynonym{relation, "connected_to", "beside"},
    NameSynonym{relation, "left", "beside", "'along' says which is further left"},
    NameSynonym{relation, "right", "beside", "'along' says which is further left"},
    NameSynonym{relation, "on_top", "above"},
    NameSynonym{relation, "over", "above"},
    NameSynonym{relation, "upper", "above"},
    NameSynonym{relation, "within", "inside"},
    NameSynonym{relation, "in", "inside"},
    NameSynonym{relation, "part_of", "inside"},
    NameSynonym{relation, "contained_in", "inside"},
    NameSynonym{relation, "contained_by", "inside"},
    NameSynonym{relation, "child_of", "inside"},
    NameSynonym{relation, "has", "contains"},
    NameSynonym{relation, "children", "contains"},
    NameSynonym{relation, "sub_objects", "contains"},
    NameSynonym{relation, "parts", "contains"},
    NameSynonym{relation, "openings", "contains"},
    NameSynonym{relation, "has_openings", "contains"},
    NameSynonym{relation, "voids", "contains"},
    NameSynonym{relation, "fills", "inside"},
    NameSynonym{relation, "parent", "host"},
    NameSynonym{relation, "super_object", "host"},
    NameSynonym{relation, "owner", "host"},
    NameSynonym{relation, "on", "host"},
    NameSynonym{relation, "wall", "", "whether it lies in a wall is asked for by 'host is wall'"},
    NameSynonym{relation, "similar", "alike"},
    NameSynonym{relation, "same", "alike"},
    NameSynonym{relation, "like", "alike"},
    NameSynonym{relation, "same_size", "alike"},
    NameSynonym{relation, "same_wall", "same_facade"},
    NameSynonym{relation, "same_floor", "same_storey"},
    NameSynonym{relation, "same_story", "same_storey"},
    NameSynonym{relation, "same_level", "same_storey"},
    NameSynonym{relation, "row", "same_storey"},

    NameSynonym{operation, "delete", "omit"},
    NameSynonym{operation, "remove", "omit"},
    NameSynonym{operation, "drop", "omit"},
    NameSynonym{operation, "eliminate", "omit"},
    NameSynonym{operation, "eliminatepolygons", "omit"},
    NameSynonym{operation, "erase", "omit"},
    NameSynonym{operation, "hide", "omit"},
    NameSynonym{operation, "exaggerate", "enlarge"},
    NameSynonym{operation, "grow", "enlarge"},
    NameSynonym{operation, "scale", "enlarge"},
    NameSynonym{operation, "widen", "enlarge"},
    NameSynonym{operation, "buffer", "enlarge"},
    NameSynonym{operation, "amalgamate", "aggregate"},
    NameSynonym{operation, "combine", "aggregate"},
    NameSynonym{operation, "join", "aggregate"},
    NameSynonym{operation, "union", "merge"},
    NameSynonym{operation, "dissolve", "merge"},
    NameSynonym{operation, "absorb", "merge"},
    NameSynonym{operation, "move", "displace"},
    NameSynonym{operation, "shift", "displace"},
    NameSynonym{operation, "symbolize", "symbolise"},
    NameSynonym{operation, "symbol", "symbolise"},
    NameSynonym{operation, "replace", "symbolise"},
    NameSynonym{operation, "select", "typify"},
    NameSynonym{operation, "thin", "typify"},
    NameSynonym{operation, "reduce", "typify"},
    NameSynonym{operation, "typification", "typify"},
    NameSynonym{operation, "simplify", "flatten"},
    NameSynonym{operation, "outline", "collapse"},

    NameSynonym{unit, "meter", "m"},
    NameSynonym{unit, "meters", "m"},
    NameSynonym{unit, "metre", "m"},
    NameSynonym{unit, "metres", "m"},
    NameSynonym{unit, "degree", "deg"},
    NameSynonym{unit, "degrees", "deg"},
    NameSynonym{unit, "grad", "deg", "360 deg are a full turn"},
    NameSynonym{unit, "rad", "deg", "a radian is 57.2958 deg"},
    NameSynonym{unit, "radians", "deg", "a radian is 57.2958 deg"},
    NameSynonym{unit, "sqm", "m2"},
    NameSynonym{unit, "qm", "m2"},
    NameSynonym{unit, "cbm", "m3"},
    NameSynonym{unit, "percent", "%"},
    NameSynonym{unit, "pct", "%"},
    NameSynonym{unit, "ft", "m", kNoFeet},
    NameSynonym{unit, "foot", "m", kNoFeet},
    NameSynonym{unit, "feet", "m", kNoFeet},
    NameSynonym{unit, "inch", "cm", kNoFeet},
    NameSynonym{unit, "inches", "cm", kNoFeet},
    NameSynonym{unit, "km", "m", "a kilometre is 1000 m"},
    NameSynonym{unit, "dm", "cm", "a decimetre is 10 cm"},

    NameSynonym{function, "avg", "mean"},
    NameSynonym{function, "average", "mean"},
    NameSynonym{function, "any", "exists"},
    NameSynonym{function, "some", "exists"},
    NameSynonym{function, "has", "exists"},
    NameSynonym{function, "every", "all"},
    NameSynonym{function, "forall", "all"},
    NameSynonym{function, "for_all", "all"},
    NameSynonym{function, "no", "none"},
    NameSynonym{function, "number", "count"},
    NameSynonym{function, "num", "count"},
    NameSynonym{function, "size", "count"},
    NameSynonym{function, "len", "count"},
    NameSynonym{function, "minimum", "min"},
    NameSynonym{function, "maximum", "max"},
    NameSynonym{function, "distance", "distance_along"},
};

/// The units that people put at the end of a name.
constexpr std::array<std::string_view, 6> kUnitEndings = {"_m2", "_m3",     "_deg",
                                                          "_m",  "_metres", "_meters"};

bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }

}  // namespace

std::span<const NameSynonym> name_synonyms() { return kNameSynonyms; }

std::string normal_name(std::string_view name) {
  std::string normal;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    const bool begins_word = is_capital(c) && i > 0 && !is_capital(name[i - 1]) &&
                             name[i - 1] != '_' && name[i - 1] != '-' && name[i - 1] != ' ';
    if (begins_word) normal += '_';
    if (c == '-' || c == ' ')
      normal += '_';
    else
      normal += is_capital(c) ? static_cast<char>(c - 'A' + 'a') : c;
  }
  for (const std::string_view ending : kUnitEndings)
    if (normal.size() > ending.size() && normal.ends_with(ending))
      return normal.substr(0, normal.size() - ending.size());
  return normal;
}

std::string unknown_name(NameKind kind, std::string_view what, std::string_view name,
                         const std::vector<std::string>& candidates, std::string_view otherwise) {
  const std::string normal = normal_name(name);
  if (normal != name && contains(candidates, normal))
    return fmt::format("unknown {} '{}'; did you mean '{}'?", what, name, normal);
  const auto* synonym = std::ranges::find_if(
      kNameSynonyms, [&](const NameSynonym& s) { return s.kind == kind && s.theirs == normal; });
  if (synonym != kNameSynonyms.end()) {
    std::string text = fmt::format("there is no {} '{}'; ", what, name);
    if (synonym->ours.empty()) return text.append(synonym->note);
    text += fmt::format("oriel calls it '{}'", synonym->ours);
    return synonym->note.empty() ? text : fmt::format("{} ({})", text, synonym->note);
  }
  const std::string near = did_you_mean(name, candidates);
  return fmt::format("unknown {} '{}'{}", what, name, near.empty() ? otherwise : near);
}

}  // namespace oriel::rules
