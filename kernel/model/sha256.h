#pragma once

#include <string>
#include <string_view>

namespace oriel {

/// The SHA-256 of `text` (FIPS 180-4) as 64 small hexadecimal digits.
std::string sha256(std::string_view text);

}  // namespace oriel
