#pragma once

#include "interpret/pack/rule_base.h"
#include "io/document.h"
#include "model/building.h"
#include "model/vec3.h"
#include "oriel/options.h"
#include "oriel/result.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// What a face of the envelope is: by the names that the pack gives surfaces.
enum class EnvelopeKind { wall, roof, ground, ceiling, floor };
/// "wall", "roof", "ground", "ceiling" (looks down, over air), "floor" (of a loggia).
std::string_view to_string(EnvelopeKind kind);

/// The eight directions that azimuths are sorted into, each 45 degrees wide, north about 0 degrees.
enum class Direction { n, ne, e, se, s, sw, w, nw };
inline constexpr std::size_t kDirections = 8;
/// "n", "ne" …
std::string_view to_string(Direction direction);
/// Of an azimuth in degrees, clockwise from north: north is 337.5 (itself in) to 22.5 (itself out).
Direction direction_of(double azimuth_deg);

/// A window or a door in the envelope.
struct EnvelopeOpening {
  std::string id;  ///< of the feature
  bool is_door = false;
  /// Within its outline, in the plane of its wall or roof.
  double area_m2 = 0;
};

/// All faces of one kind in one plane.
struct EnvelopeFace {
  EnvelopeKind kind = EnvelopeKind::wall;
  Vec3 normal;  ///< out of the building
  double offset_m = 0;
  double inclination_deg = 0;         ///< 0 faces up, 90 is a wall, 180 faces down
  std::optional<double> azimuth_deg;  ///< clockwise from north; missing within 1 degree of level
  double area_m2 = 0;                 ///< with its openings
  /// Of it, what lies against other buildings; missing if these are not known.
  std::optional<double> party_m2{};
  std::vector<EnvelopeOpening> openings{};

  /// What is exposed to air or ground.
  [[nodiscard]] double exposed_m2() const { return area_m2 - party_m2.value_or(0); }
};

/// The form of a roof (docs/energy.md#roof-form).
enum class RoofForm { none, flat, shed, gabled, hipped, pyramidal, mansard, other };
std::string_view to_string(RoofForm form);

/// Slopes of roofs in degrees from which a class begins; the first has no direction.
inline constexpr std::array kSlopeClasses_deg{0.0, 10.0, 30.0, 45.0};

/// What somebody who works out the energy of a building asks of its geometry and labels.
struct BuildingEnergy {
  std::string building;
  std::string lod;
  /// Something is known: the building came to a body.
  bool is_known = false;
  /// No wall of the body was assumed.
  bool is_closed = false;
  double volume_m3 = 0;
  double height_m = 0;  ///< of the body's highest point over its lowest
  std::vector<EnvelopeFace> faces;
  /// Openings and unheated parts that no cut takes off: their surfaces are left out and their areas
  /// and volumes added, as far as these are known.
  int not_separated = 0;
  std::optional<int> storeys;
  /// "attribute" or "openings".
  std::string storeys_source;
  RoofForm roof_form = RoofForm::none;
};

struct EnergyOptions {
  /// Classes of the pack whose features are no part of the heated body; those that it does not have
  /// do not matter.
  std::vector<std::string> unheated{"balcony", "canopy", "chimney", "stairs", "vent"};
};

/// "the pack has no class 'balkony'; did you mean 'balcony'?", of the first such name in
/// EnergyOptions::unheated that is neither empty nor one of the default; else empty.
std::string unknown_class(const RuleBase& rules, const EnergyOptions& energy);

/// The envelope of a building and what is counted in it (docs/energy.md defines each number).
///
/// The heated body is the building's solid without its openings, which are filled up to the plane
/// of their wall, and without unheated parts, with what sits on them. `result` is what label() said
/// of `building` with the same rules and options; of the attributes of features none is read. Of a
/// building without a body nothing is known. With PipelineResult::surroundings walls that lie
/// against other buildings are told apart.
BuildingEnergy energy_of(const Building& building, const PipelineResult& result,
                         const RuleBase& rules, const PipelineOptions& options = {},
                         const EnergyOptions& energy = {});

/// By building of a document: how many storeys above the ground the input says that it has
/// (CityJSON's attribute storeysAboveGround of the object itself). Missing where it does not.
std::vector<std::optional<int>> stated_storeys(const Document& document);

/// A CityJSON file, or a line of a CityJSONSeq, with what the CityJSON Energy extension (Tufan
/// 2022) has for the geometry of buildings: the extension is declared where the text is a whole
/// file or the header of a stream, and each building that something is known of gets its volume, a
/// ThermalZone, a ThermalBoundary for each of its faces and a ThermalOpening for each opening
/// (docs/energy.md#in-cityjson). What an earlier call wrote of these buildings is replaced, or
/// goes if nothing is known of them now; all else stays byte for byte. `text` must be one that
/// write() made.
std::string with_energy_extension(const std::string& text, const std::vector<BuildingEnergy>& of);

/// The tables that buildings and their envelopes are written in.
enum class EnergyTable {
  buildings,  ///< one row for each building
  envelope    ///< one row for each face of its envelope
};
/// "energy", "envelope".
std::string_view to_string(EnergyTable table);

/// Formats of tables: with a first line of names; an array of objects; an object a line.
enum class TableFormat { csv, json, jsonl };

/// The names of the columns, with their units.
std::vector<std::string> energy_columns(EnergyTable table);

/// The rows of a building, each with its line end, in JSON with commas between them. Numbers have
/// the fewest digits that read back to the same double; missing values are empty, or null.
std::string energy_rows(EnergyTable table, TableFormat format, const BuildingEnergy& of);

}  // namespace oriel
