#pragma once

#include "model/solid.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace oriel {

/// A flat member of an output object (output.md: no object inside a value).
using MemberValue = std::variant<std::string, double, std::int64_t, bool>;
using Members = std::vector<std::pair<std::string, MemberValue>>;

/// What is said of a feature, or of a surface that is none's. What is empty is not said.
struct FeatureLabel {
  /// Codes of an installation, the function's out of `codelist`.
  std::string class_code{}, function{}, codelist{};
  /// Content-based, an NCName.
  std::string id{};
  /// For people: feature_names().
  std::string name{};
  /// The class that is written, and the one beneath it that the feature was given, if any.
  std::string label{}, subclass{};
  std::optional<double> score{};
  std::string rule{};
  /// Ids of its groups, and of its parts.
  std::vector<std::string> groups{}, parts{};
  /// The reason in one line.
  std::string why{};
  /// Of a wall: whether it is a party wall, the share of it that lies open, and what it looks at,
  /// "street" or "yard".
  std::optional<bool> is_party_wall{};
  std::optional<double> exposed{};
  std::string faces{};
  /// What a file says besides.
  Members others{};

  friend bool operator==(const FeatureLabel&, const FeatureLabel&) = default;
  /// What the feature was given.
  [[nodiscard]] const std::string& given() const { return subclass.empty() ? label : subclass; }
};

/// A label that is held once by all that is written of a feature; by default it says nothing.
class SharedLabel {
 public:
  SharedLabel() = default;
  SharedLabel(FeatureLabel label)
      : label_(std::make_shared<const FeatureLabel>(std::move(label))) {}

  const FeatureLabel& operator*() const {
    static const FeatureLabel kNothing;
    return label_ ? *label_ : kNothing;
  }
  const FeatureLabel* operator->() const { return &**this; }
  friend bool operator==(const SharedLabel& a, const SharedLabel& b) {
    return a.label_ == b.label_ || *a == *b;
  }

 private:
  std::shared_ptr<const FeatureLabel> label_;
};

/// True for the semantic surfaces that lie in others.
inline bool is_opening_type(std::string_view type) { return type == "Window" || type == "Door"; }

/// A semantic surface to be written: one per feature that is an opening (pane and reveals
/// together), one per wall, roof or ground polygon.
struct SemanticSurface {
  /// CityJSON semantic surface type: WallSurface, RoofSurface, GroundSurface, Window, Door, …
  std::string type{};
  /// For an opening, the surface it lies in: an index into LabelledBuilding::surfaces. -1: none.
  int parent = -1;
  SharedLabel label{};
};

/// A part to be written as a BuildingInstallation, child of the building that hosts it.
struct Installation {
  /// Content-based, an NCName.
  std::string id;
  SharedLabel label;
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
