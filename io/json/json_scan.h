#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace oriel {

/// Where something stands in a text.
struct TextRange {
  std::size_t begin = 0, end = 0;
};

/// The offset of the first byte from `at` on that is no white space of JSON.
std::size_t skip_space(std::string_view text, std::size_t at);

/// The offset behind the JSON value that starts at `text[at]`. No recursion: depth costs nothing.
/// `text` must be valid JSON from there on; of other text the result is some offset ≤ text.size().
/// `known` are arrays of which is known where they end, so that they are passed over: ascending,
/// none in another one. Of them only those count that are slices of `text`.
std::size_t end_of_value(std::string_view text, std::size_t at,
                         std::span<const std::string_view> known = {});

/// Goes through the members of the object that starts at `text[at]`: `visit(key, at)` gets the raw
/// key, with its quotes, and the offset of the value, and returns that behind it. Returns the
/// offset behind the object; of other text some offset ≤ text.size().
template <class Visit>
std::size_t for_each_member(std::string_view text, std::size_t at, const Visit& visit) {
  at = skip_space(text, at + 1);
  while (at < text.size() && text[at] == '"') {
    const std::size_t end = end_of_value(text, at);
    const std::string_view key = text.substr(at, end - at);
    const std::size_t value = skip_space(text, std::min(skip_space(text, end) + 1, text.size()));
    at = skip_space(text, visit(key, value));
    if (at >= text.size() || text[at] != ',') break;
    at = skip_space(text, at + 1);
  }
  return std::min(at + 1, text.size());
}

/// Appends the arrays that are elements of the array `text`, in which there is no string and no
/// object, at whatever depth.
void append_arrays_in(std::string_view text, std::vector<std::string_view>& arrays);

}  // namespace oriel
