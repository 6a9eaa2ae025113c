#pragma once

#include "examples/generator/output/cityjson.h"

#include <string>

namespace oriel::generator {

/// The versions of CityGML that are written.
enum class CityGml { v2, v3 };

/// A CityGML file with one building: a lod 3 Solid. With Content::labelled its polygons stand in
/// boundary surfaces and openings, to which the solid and the BuildingInstallations link; else they
/// stand in the solid, without semantics and attributes. Coordinates are exact to the micrometre.
std::string citygml(const Building& building, Content content, CityGml version);

/// The pieces of a file with several buildings: its start, one building, its end.
std::string citygml_head(CityGml version);
std::string citygml_member(const Building& building, Content content, CityGml version);
std::string citygml_foot();

}  // namespace oriel::generator
