#pragma once

#include <string>

namespace oriel::detail {

/// Gives a CityJSON text a transform that has none, as CityJSON 1.0 allows: there "vertices" are
/// the coordinates themselves. They become whole millimetres, or micrometres (rounded) if not all
/// of them are such, from the least corner in whole metres; all other bytes stay.
///
/// `text` is valid JSON, an object without "transform". A vertex that is not three numbers stays as
/// it is, one that is further off than any building becomes a number that is as far off. Without
/// an array "vertices" nothing changes.
void add_transform(std::string& text);

}  // namespace oriel::detail
