#pragma once

#include <string>
#include <string_view>

namespace oriel {

/// Escapes a text for XML, HTML and SVG, between tags or in an attribute's quotes. What XML 1.0
/// cannot hold, control characters and bytes that are not UTF-8, becomes U+FFFD.
std::string escaped_xml(std::string_view text);

}  // namespace oriel
