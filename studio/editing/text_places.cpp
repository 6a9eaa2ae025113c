#include "studio/editing/text_places.h"

#include <algorithm>
#include <utility>

namespace oriel {

namespace {

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

/// Units of UTF-16 of the character that begins with this byte of UTF-8.
int utf16_units(char c) { return static_cast<unsigned char>(c) >= 0xF0U ? 2 : 1; }

}  // namespace

std::string with_edits(std::string text, std::vector<TextEdit> edits) {
  std::ranges::sort(edits, std::ranges::greater{}, &TextEdit::where);
  for (const TextEdit& edit : edits)
    text.replace(edit.where.begin, edit.where.end - edit.where.begin, edit.text);
  return text;
}

TextPlaces::TextPlaces(std::string_view text) : text_(text), starts_{0} {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') starts_.push_back(i + 1);
}

TextPlace TextPlaces::place(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto next = std::ranges::upper_bound(starts_, offset);
  TextPlace place{static_cast<int>(next - starts_.begin()), 1};
  for (std::size_t i = *(next - 1); i < offset; ++i)
    if (begins_character(text_[i])) place.column += utf16_units(text_[i]);
  return place;
}

std::size_t TextPlaces::offset(TextPlace place) const {
  if (place.line < 1) return 0;
  if (place.line > line_count()) return text_.size();
  std::size_t at = starts_[static_cast<std::size_t>(place.line) - 1];
  std::size_t end = std::min(text_.find('\n', at), text_.size());
  if (end > at && text_[end - 1] == '\r') --end;
  int column = 1;
  while (at < end && column < place.column) {
    column += utf16_units(text_[at]);
    do ++at;
    while (at < end && !begins_character(text_[at]));
  }
  return at;
}

}  // namespace oriel
