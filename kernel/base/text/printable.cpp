#include "kernel/base/text/printable.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel {

namespace {

constexpr bool is_continuation_byte(unsigned byte) { return (byte & 0xC0U) == 0x80U; }

unsigned byte_at(std::string_view text, std::size_t at) {
  return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
}

/// The code point of the UTF-8 sequence of `length` bytes at `text[at]`.
unsigned code_point(std::string_view text, std::size_t at, std::size_t length) {
  const unsigned first = byte_at(text, at);
  if (length == 1) return first;
  unsigned point = first & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) point = (point << 6U) | (byte_at(text, at + i) & 0x3FU);
  return point;
}

constexpr bool is_control(unsigned point) {
  return point < 0x20U || (point >= 0x7FU && point <= 0x9FU);
}

/// Ends of lines, and the property Bidi_Control.
constexpr bool is_end_or_turn(unsigned point) {
  return point == 0x061CU || point == 0x200EU || point == 0x200FU ||
         (point >= 0x2028U && point <= 0x202EU) || (point >= 0x2066U && point <= 0x2069U);
}

/// What needs no second look: the text of nearly every message.
bool is_plain(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

void append_escaped(std::string& out, unsigned point) {
  if (point == '\n')
    out += "\\n";
  else if (point == '\r')
    out += "\\r";
  else if (point == '\t')
    out += "\\t";
  else
    out += point < 0x80U ? fmt::format("\\x{:02x}", point) : fmt::format("\\u{:04x}", point);
}

std::string escaped_text(std::string_view text, std::string_view kept) {
  if (is_plain(text)) return std::string(text);
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0)
      out += fmt::format("\\x{:02x}", byte_at(text, at));
    else if (is_printable(text, at) || kept.find(text[at]) != std::string_view::npos)
      out += text.substr(at, length);
    else
      append_escaped(out, code_point(text, at, length));
    at += std::max<std::size_t>(length, 1);
  }
  return out;
}

}  // namespace

std::size_t utf8_length(std::string_view text, std::size_t at) {
  const unsigned first = byte_at(text, at), second = byte_at(text, at + 1);
  if (first < 0x80U) return 1;
  const std::size_t length = first >= 0xF0U ? 4 : first >= 0xE0U ? 3 : 2;
  if (first < 0xC2U || first > 0xF4U) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (!is_continuation_byte(byte_at(text, at + i))) return 0;
  // Overlong forms, surrogates and code points beyond U+10FFFF.
  if ((first == 0xE0U && second < 0xA0U) || (first == 0xEDU && second > 0x9FU)) return 0;
  if ((first == 0xF0U && second < 0x90U) || (first == 0xF4U && second > 0x8FU)) return 0;
  return length;
}

bool is_printable(std::string_view text, std::size_t at) {
  const std::size_t length = utf8_length(text, at);
  if (length == 0) return false;
  const unsigned point = code_point(text, at, length);
  return !is_control(point) && !is_end_or_turn(point);
}

std::string printable(std::string_view text) { return escaped_text(text, {}); }

std::string printable_lines(std::string_view text) { return escaped_text(text, "\n\t"); }

}  // namespace oriel
