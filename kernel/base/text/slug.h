#pragma once

#include <string>
#include <string_view>

namespace oriel {

/// Makes a name of a file or label of a text: small letters, digits and hyphens. Capital letters
/// become small ones, all other runs of characters one hyphen.
std::string slug_of(std::string_view text);

}  // namespace oriel
