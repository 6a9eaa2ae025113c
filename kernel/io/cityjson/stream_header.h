#pragma once

#include <string>
#include <string_view>

namespace oriel {

/// What the lines behind a CityJSON header depend on: version, transform and reference system, as
/// one JSON text. `header` is a JSON object. Lines behind headers with the same facts may share one
/// header.
std::string stream_header_facts(std::string_view header);

/// What files depend on that become one file, whatever their grids: version, reference system, and
/// a hash of the geometry templates if there are any.
std::string file_facts(std::string_view header);

}  // namespace oriel
