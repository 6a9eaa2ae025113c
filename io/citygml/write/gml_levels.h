#pragma once

#include "io/citygml/write/gml_attributes.h"
#include "io/objects/city_record.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// The geometries of an object that are written at one of CityGML's levels; null: none.
struct GmlLevel {
  const CityGeometry* solid = nullptr;
  const CityGeometry* surfaces = nullptr;
};
using GmlLevels = std::map<char, GmlLevel>;

/// True for a surface type that CityGML has as a boundary surface.
bool is_boundary(std::string_view type);

/// Where each object of a record has its geometries, as citygml_text() says.
class GmlRecordLevels {
 public:
  GmlRecordLevels(const CityRecord& record, GmlVersion version);

  [[nodiscard]] const GmlLevels& of(std::size_t object) const { return levels_[object]; }
  /// The surface that each polygon of a geometry is written in, in reading order: an index into its
  /// surfaces, or -1.
  [[nodiscard]] std::vector<int> surfaces_of(const CityGeometry& geometry, char lod) const;

 private:
  void choose(const CityObject& object, GmlLevels& levels) const;
  void raise_openings(const CityRecord& record);

  GmlVersion version_;
  std::vector<GmlLevels> levels_;
};

}  // namespace oriel::detail
