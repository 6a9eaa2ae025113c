#pragma once

#include <string>

namespace oriel::detail {

/// What defines a reference system in a GeoPackage: its well-known text (OGC 01-009) on one line,
/// as PROJ knows the system by its organization and number; "undefined" where PROJ does not know
/// it. Source: OGC 12-128r18, table 3.
std::string crs_definition(const std::string& organization, int number);

}  // namespace oriel::detail
