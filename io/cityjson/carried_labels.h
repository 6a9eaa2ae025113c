#pragma once

#include "io/document.h"
#include "model/labelled_building.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// A feature as a file says it: a semantic surface or a BuildingInstallation with an id.
struct CarriedFeature {
  FeatureLabel said;
  /// Polygon::source of the building's polygons, ascending.
  std::vector<int> polygons;
};

struct CarriedSurface {
  /// The semantic surface type, empty where there is none.
  std::string type;
  std::string why;
};

/// What a labelled or generalised building says of itself (docs/formats.md).
struct CarriedLabels {
  /// In the order of the file, surfaces first; those of one id are one feature.
  std::vector<CarriedFeature> features;
  /// By Polygon::source.
  std::vector<CarriedSurface> surfaces;
};

/// Reads the labels that oriel wrote into a CityJSON file or a line of a CityJSONSeq.
class CarriedLabelReader {
 public:
  /// `document` must outlive the reader.
  explicit CarriedLabelReader(const Document& document);
  ~CarriedLabelReader();
  CarriedLabelReader(const CarriedLabelReader&) = delete;
  CarriedLabelReader& operator=(const CarriedLabelReader&) = delete;

  /// Of the building with that number in the document; nothing if it has no `oriel_pack`: then
  /// oriel did not write it. Installations that share the building's polygons (`oriel_geometry`)
  /// are features with these polygons.
  [[nodiscard]] std::optional<CarriedLabels> labels_of(std::size_t building) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel
