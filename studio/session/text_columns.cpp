#include "studio/session/text_columns.h"

namespace oriel::studio {

namespace {

bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

/// Of the character that begins with this byte: those beyond the first plane have two.
int utf16_units(char first) { return static_cast<unsigned char>(first) >= 0xF0U ? 2 : 1; }

}  // namespace

std::string_view line_of_text(std::string_view text, int line) {
  for (; line > 1; --line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

int utf16_column(std::string_view line, int character_column) {
  int characters = 1, units = 1;
  for (const char c : line) {
    if (!starts_character(c)) continue;
    if (characters >= character_column) break;
    ++characters;
    units += utf16_units(c);
  }
  return units + (character_column - characters);
}

int character_column(std::string_view line, int utf16_column) {
  int characters = 1, units = 1;
  for (const char c : line) {
    if (!starts_character(c)) continue;
    if (units >= utf16_column) break;
    ++characters;
    units += utf16_units(c);
  }
  return characters + (utf16_column > units ? utf16_column - units : 0);
}

}  // namespace oriel::studio
