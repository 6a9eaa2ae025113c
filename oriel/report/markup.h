#pragma once

#include <string>

namespace oriel::report {

/// A text as it may stand in HTML and SVG, also in an attribute: printable, with entities for & < >
/// and ".
std::string escaped_markup(const std::string& text);

}  // namespace oriel::report
