#pragma once

#include "kernel/io/json/json_text.h"
#include "kernel/model/vec3.h"

#include <array>
#include <string>
#include <string_view>

/// Members of JSON objects that are being written (append_json_key).
namespace oriel::detail {

template <class Value>
void append_field(std::string& out, std::string_view key, const Value& value) {
  append_json_key(out, key);
  append_json(out, value);
}

/// `key:[x,y,z]`.
inline void append_vector(std::string& out, std::string_view key, Vec3 v) {
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

}  // namespace oriel::detail
