#pragma once

#include "examples/generator/house/body.h"

#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel::generator {

/// JSON as it grows. What is appended must be valid where it stands; names need no escapes.
using Json = fmt::memory_buffer;

inline void append_text(Json& json, std::string_view text) {
  json.append(text.data(), text.data() + text.size());
}

inline void append_number(Json& json, Um number) {
  const fmt::format_int text(number);
  json.append(text.data(), text.data() + text.size());
}

template <class... Values>
void append_format(Json& json, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(json), format, std::forward<Values>(values)...);
}

/// A length in metres, exactly, without trailing zeros.
void append_metres(Json& json, Um length);
/// [x, y, z] in metres.
void append_metres(Json& json, Point point);
/// [xmin, ymin, zmin, xmax, ymax, zmax] in metres.
void append_metres(Json& json, const Extent& extent);

/// Appends the items in brackets, separated by commas; `append_item` is called for each.
template <class Items, class AppendItem>
void append_list(Json& json, const Items& items, const AppendItem& append_item) {
  json.push_back('[');
  bool is_first = true;
  for (const auto& item : items) {
    if (!is_first) json.push_back(',');
    is_first = false;
    append_item(item);
  }
  json.push_back(']');
}

}  // namespace oriel::generator
