#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace oriel {

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

/// `key:value`, a member of the object that is being written (append_json_key).
template <class Value>
void append_field(std::string& out, std::string_view key, const Value& value) {
  append_json_key(out, key);
  append_json(out, value);
}

/// `key:[x,y,z]`.
template <class Vector>
void append_vector(std::string& out, std::string_view key, const Vector& v) {
  append_json_key(out, key);
  append_json_array(out, std::array{v.x, v.y, v.z});
}

/// `key:[…]`, each element of `values` as `append(value)` writes it.
template <class Values, class Append>
void append_list(std::string& out, std::string_view key, const Values& values,
                 const Append& append) {
  append_json_key(out, key);
  out += '[';
  for (const auto& value : values) {
    if (&value != &*values.begin()) out += ',';
    append(value);
  }
  out += ']';
}

/// `key:[{…},…]`, each element of `values` an object with the members that `append(value)` writes.
template <class Values, class Append>
void append_objects(std::string& out, std::string_view key, const Values& values,
                    const Append& append) {
  append_list(out, key, values, [&](const auto& value) {
    out += '{';
    append(value);
    out += '}';
  });
}

}  // namespace oriel

namespace oriel {

/// A text as append_json() writes it.
std::string json_string(std::string_view text);

/// `value` with the fewest digits that read back to the same double, without an exponent from 1e-4
/// to 1e16; null if it is not finite.
std::string json_number(double value);

}  // namespace oriel
