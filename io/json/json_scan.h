#pragma once

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

/// Appends the arrays that are elements of the array `text`, in which there is no string and no
/// object, at whatever depth.
void append_arrays_in(std::string_view text, std::vector<std::string_view>& arrays);

}  // namespace oriel
