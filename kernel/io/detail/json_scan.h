#pragma once

#include <cstddef>
#include <string_view>

namespace oriel::detail {

/// The offset of the first byte from `at` on that is no white space of JSON.
std::size_t skip_space(std::string_view text, std::size_t at);

/// The offset behind the JSON value that starts at `text[at]`. No recursion: depth costs nothing.
/// `text` must be valid JSON from there on; of other text the result is some offset ≤ text.size().
std::size_t end_of_value(std::string_view text, std::size_t at);

}  // namespace oriel::detail
