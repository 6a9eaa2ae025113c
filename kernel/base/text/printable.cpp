#include "kernel/base/text/printable.h"

#include <algorithm>

#include <fmt/format.h>
#include <utf8.h>

namespace oriel {

namespace {

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
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at]));
    else if (is_printable(text, at) || kept.find(text[at]) != std::string_view::npos)
      out += text.substr(at, length);
    else
      append_escaped(out, utf8::unchecked::peek_next(text.data() + at));
    at += std::max<std::size_t>(length, 1);
  }
  return out;
}

}  // namespace

std::size_t utf8_length(std::string_view text, std::size_t at) {
  if (static_cast<unsigned char>(text[at]) < 0x80U) return 1;
  const std::string_view rest = text.substr(at, 4);
  if (utf8::find_invalid(rest) == 0) return 0;
  const char* next = rest.data();
  utf8::unchecked::next(next);
  return static_cast<std::size_t>(next - rest.data());
}

bool is_printable(std::string_view text, std::size_t at) {
  if (utf8_length(text, at) == 0) return false;
  const unsigned point = utf8::unchecked::peek_next(text.data() + at);
  return !is_control(point) && !is_end_or_turn(point);
}

std::string printable(std::string_view text) { return escaped_text(text, {}); }

std::string printable_lines(std::string_view text) { return escaped_text(text, "\n\t"); }

}  // namespace oriel
