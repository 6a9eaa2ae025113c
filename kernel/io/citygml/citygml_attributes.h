#pragma once

#include "kernel/io/citygml/xml_node.h"

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

}  // namespace oriel::detail
