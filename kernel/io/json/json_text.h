#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace oriel::detail {

/// Append a JSON value to `out`. Strings are quoted and escaped, what is not UTF-8 in them becomes
/// U+FFFD; numbers have the fewest digits that read back to the same double, and what is not finite
/// becomes null.
void append_json(std::string& out, std::string_view text);
void append_json(std::string& out, double number);
void append_json(std::string& out, std::int64_t number);
void append_json(std::string& out, int number);
void append_json(std::string& out, bool value);
/// `const char*` would turn into bool.
void append_json(std::string& out, const char* text) = delete;

/// Appends `[a,b,…]`.
template <class Range>
void append_json_array(std::string& out, const Range& values) {
  out += '[';
  const char* separator = "";
  for (const auto& value : values) {
    out += separator;
    append_json(out, value);
    separator = ",";
  }
  out += ']';
}

/// Appends `"key":`, after a comma unless it is the first member of the object that is being
/// written.
void append_json_key(std::string& out, std::string_view key);

/// `number` with the fewest digits that read back to the same double; "nan", "inf" as such.
std::string shortest(double number);

}  // namespace oriel::detail
