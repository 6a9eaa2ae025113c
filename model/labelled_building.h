#pragma once

#include "model/solid.h"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace oriel {

/// A flat member of an output object (output.md: no object inside a value).
using MemberValue = std::variant<std::string, double, std::int64_t, bool>;
using Members = std::vector<std::pair<std::string, MemberValue>>;

/// A semantic surface to be written: one per feature that is an opening (pane and reveals
/// together), one per wall, roof or ground polygon.
struct SemanticSurface {
  /// CityJSON semantic surface type: WallSurface, RoofSurface, GroundSurface, Window, Door, …
  std::string type;
  /// For an opening, the surface it lies in: an index into LabelledBuilding::surfaces. -1: none.
  int parent = -1;
  Members members;
};

/// A part to be written as a BuildingInstallation, child of the building that hosts it.
struct Installation {
  /// Content-based, an NCName.
  std::string id;
  /// Attributes: class, function, oriel_*.
  Members attributes;
  /// The polygons of its MultiSurface, numbered like LabelledBuilding::surface_of_polygon.
  std::vector<int> polygons;
  /// What those polygons are, indices into LabelledBuilding::surfaces, parallel to `polygons`; -1:
  /// nothing.
  std::vector<int> surfaces;
};

/// One building as it is to be written: see design of output (docs/formats.md).
struct LabelledBuilding {
  /// Building::id of the input building.
  std::string building;
  std::vector<SemanticSurface> surfaces;
  /// For each polygon the index of its surface or -1. Polygons are the input's (Polygon::source)
  /// or, if `geometry` is set, its facets.
  std::vector<int> surface_of_polygon;
  std::vector<Installation> installations;
  /// Attributes added to the building: oriel_version, oriel_pack, …
  Members attributes;
  /// Attributes that leave the building.
  std::vector<std::string> dropped_attributes{};
  /// Replaces the input geometry, in the input's frame; missing: the input's polygons stay as they
  /// are.
  std::optional<Solid> geometry;
  /// The level of detail that `geometry` is written with; empty: the input's. Buildings with the
  /// same id and several levels stand one behind the other.
  std::string lod{};
  /// With `geometry`: facets whose polygons all have one semantic surface in the input keep that.
  bool keeps_semantics = false;
};

}  // namespace oriel
