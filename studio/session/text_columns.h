#pragma once

#include <cstddef>
#include <string_view>

namespace oriel::studio {

/// Line `line` of a text, counted from 1, without its line end; empty where there is none.
std::string_view line_of_text(std::string_view text, int line);

/// Columns, counted from 1: of characters, as places in packs have them, and of UTF-16 units, as
/// pages and editors have them. A column behind the line stays as far behind it.
int utf16_column(std::string_view line, int character_column);
int character_column(std::string_view line, int utf16_column);

}  // namespace oriel::studio
