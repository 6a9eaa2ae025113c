#pragma once

#include <string>
#include <string_view>

namespace oriel::detail {

/// The name of a level of detail that stands so in a JSON text: a string, as CityJSON has it from
/// 1.1 on, or a number, as CityJSON 1.0 has it: "2" for 2, "2.0" for 2.0, "2.2" for 2.2. Empty for
/// anything else.
std::string lod_name(std::string_view lod);

/// The JSON text of the level called `name`: a number if that of its neighbour `like` is one.
std::string lod_text(std::string_view name, std::string_view like);

}  // namespace oriel::detail
