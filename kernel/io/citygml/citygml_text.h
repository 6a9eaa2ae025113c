#pragma once

#include "kernel/io/citygml/citygml_objects.h"
#include "kernel/io/citygml/gml_geometry.h"
#include "kernel/io/cityjson/cityjson_reader.h"

#include <string>

namespace oriel::detail {

/// The scale of what CityGML becomes: whole micrometres.
constexpr double kCityGmlScale = 1e-6;

/// The header line of the CityJSONSeq that a CityGML file becomes.
std::string citygml_header_text(const SequenceHeader& header);

/// The CityJSONFeature of a building, its vertices in micrometres from the header's origin.
/// Semantic surfaces that polygons have carry their gml:id as "id", their attributes, and `parent`
/// and `children` between openings and what they lie in.
std::string citygml_feature_text(const CityGmlBuilding& building, const GmlVertices& vertices);

/// A coordinate reference system as CityJSON wants it: EPSG codes ("EPSG:25832",
/// "urn:ogc:def:crs:EPSG::25832", "http://www.opengis.net/def/crs/EPSG/0/25832") as
/// "https://www.opengis.net/def/crs/EPSG/0/25832", all else as it is.
std::string reference_system_of(std::string_view srs_name);

}  // namespace oriel::detail
