#pragma once

#include "io/citygml/citygml_objects.h"
#include "io/citygml/gml_geometry.h"
#include "io/citygml/xml_node.h"
#include "io/cityjson/cityjson_reader.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// Appends the attributes of a city object or boundary surface as members of the JSON object that
/// is being written: every property of CityGML, GML or the generics module that is plain text
/// (class, roofType, name…), generic attributes under their own name, sets of them as objects, and
/// the first con:height as measuredHeight. A name that occurs several times gets an array.
///
/// measuredHeight is a number; storeysAboveGround, storeysBelowGround, yearOfConstruction,
/// yearOfDemolition are whole numbers; the storeyHeights lists of numbers; generic attributes what
/// their type says. What is no number where one is expected stays text. Names in `reserved` get an
/// underscore in front.
void append_attributes(std::string& out, const XmlNode& object,
                       const std::vector<std::string_view>& reserved = {});

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
