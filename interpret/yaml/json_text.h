#pragma once

#include <string>
#include <string_view>

namespace oriel::rules {

/// `text` as a JSON string with its quotes; control characters are escaped.
std::string json_string(std::string_view text);

/// The shortest number that reads back as `value`; null if it is not finite.
std::string json_number(double value);

}  // namespace oriel::rules
