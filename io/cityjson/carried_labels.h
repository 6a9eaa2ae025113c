#pragma once

#include "io/document.h"
#include "io/json/raw_json.h"
#include "model/labelled_building.h"

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace oriel {

/// A feature as a file says it: a semantic surface or a BuildingInstallation with an id.
struct CarriedFeature {
  FeatureLabel said;
  /// Polygon::source of the building's polygons, ascending.
  std::vector<int> polygons;
};

/// What a labelled or generalised building says of itself (docs/formats.md).
struct CarriedLabels {
  /// In the order of the file, surfaces first; those of one id are one feature.
  std::vector<CarriedFeature> features;
  /// The semantic surface types by Polygon::source, empty where there is none.
  std::vector<std::string> types;
};

/// Reads the labels that oriel wrote into a CityJSON file or a line of a CityJSONSeq.
class CarriedLabelReader {
 public:
  /// `document` must outlive the reader.
  explicit CarriedLabelReader(const Document& document);

  /// Of the building with that number in the document; nothing if it has no `oriel_pack`: then
  /// oriel did not write it. Installations that share the building's polygons (`oriel_geometry`)
  /// are features with these polygons.
  [[nodiscard]] std::optional<CarriedLabels> labels_of(std::size_t building) const;

 private:
  void read_installation(std::string_view object,
                         const std::unordered_map<std::string_view, int>& polygon_of,
                         CarriedLabels& labels) const;

  const Document& document_;
  std::optional<RawNode> objects_;
  std::unordered_map<std::string, std::size_t> number_of_;
};

}  // namespace oriel
