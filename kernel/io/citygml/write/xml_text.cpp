#include "kernel/io/citygml/write/xml_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
constexpr char32_t kReplaced = 0xFFFD;
/// The id without a character, and what is written for it.
constexpr std::string_view kEmptyId = "_x00_";

/// A character of a UTF-8 text: its number, and how many bytes it takes. A byte that begins none is
/// U+FFFD.
struct Character {
  char32_t number = 0;
  std::size_t bytes = 1;
};

Character character_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80U) return {lead, 1};
  const std::size_t bytes = lead >= 0xF0U ? 4 : lead >= 0xE0U ? 3 : 2;
  if (lead < 0xC2U || lead > 0xF4U || at + bytes > text.size()) return {kReplaced, 1};
  char32_t number = lead & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {kReplaced, 1};
    number = number << 6U | (byte(i) & 0x3FU);
  }
  const bool is_overlong = (bytes == 3 && number < 0x800) || (bytes == 4 && number < 0x10000);
  const bool is_surrogate = number >= 0xD800 && number <= 0xDFFF;
  if (is_overlong || is_surrogate || number > 0x10FFFF) return {kReplaced, 1};
  return {number, bytes};
}

void append_utf8(std::string& out, char32_t number) {
  const auto put = [&](char32_t byte) { out += static_cast<char>(byte); };
  if (number < 0x80) return put(number);
  if (number < 0x800) {
    put(0xC0U | number >> 6U);
  } else {
    if (number < 0x10000) {
      put(0xE0U | number >> 12U);
    } else {
      put(0xF0U | number >> 18U);
      put(0x80U | (number >> 12U & 0x3FU));
    }
    put(0x80U | (number >> 6U & 0x3FU));
  }
  put(0x80U | (number & 0x3FU));
}

/// XML 1.0, production Char.
bool is_xml(char32_t c) {
  return c == '\t' || c == '\n' || c == '\r' || (c >= 0x20 && c <= 0xD7FF) ||
         (c >= 0xE000 && c <= 0xFFFD) || c >= 0x10000;
}

using CharacterRange = std::pair<char32_t, char32_t>;

/// Names in XML, fifth edition, NameStartChar without the colon.
constexpr std::array<CharacterRange, 15> kStarts{{{'A', 'Z'},
                                                  {'_', '_'},
                                                  {'a', 'z'},
                                                  {0xC0, 0xD6},
                                                  {0xD8, 0xF6},
                                                  {0xF8, 0x2FF},
                                                  {0x370, 0x37D},
                                                  {0x37F, 0x1FFF},
                                                  {0x200C, 0x200D},
                                                  {0x2070, 0x218F},
                                                  {0x2C00, 0x2FEF},
                                                  {0x3001, 0xD7FF},
                                                  {0xF900, 0xFDCF},
                                                  {0xFDF0, 0xFFFC},
                                                  {0x10000, 0xEFFFF}}};
/// What NameChar adds.
constexpr std::array<CharacterRange, 5> kFurther{
    {{'-', '.'}, {'0', '9'}, {0xB7, 0xB7}, {0x300, 0x36F}, {0x203F, 0x2040}}};

template <std::size_t n>
bool is_in(char32_t c, const std::array<CharacterRange, n>& ranges) {
  return std::ranges::any_of(
      ranges, [&](const CharacterRange& range) { return c >= range.first && c <= range.second; });
}

/// The character that `_xHHHH_` at this place stands for, and its length.
std::optional<Character> escape_at(std::string_view text, std::size_t at) {
  if (text.substr(at, 2) != "_x") return std::nullopt;
  const std::size_t end = text.find('_', at + 2);
  if (end == std::string_view::npos || end < at + 6 || end > at + 8) return std::nullopt;
  std::uint32_t number = 0;
  const char* const last = text.data() + end;
  const auto [stop, error] = std::from_chars(text.data() + at + 2, last, number, 16);
  if (error != std::errc() || stop != last || number > 0x10FFFF) return std::nullopt;
  return Character{number, end + 1 - at};
}

}  // namespace

void append_xml(std::string& out, std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto [c, bytes] = character_at(text, at);
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\t' || c == '\n' || c == '\r')
      out += fmt::format("&#{};", static_cast<int>(c));
    else if (c == kReplaced || !is_xml(c))
      out += kReplacement;
    else
      out += text.substr(at, bytes);
    at += bytes;
  }
}

void append_element(std::string& out, std::string_view name, std::string_view text,
                    std::string_view attributes) {
  out += '<';
  out += name;
  out += attributes;
  out += '>';
  append_xml(out, text);
  out += "</";
  out += name;
  out += ">\n";
}

std::string xml_id(std::string_view id) {
  std::string result;
  if (id.empty()) return std::string(kEmptyId);
  for (std::size_t at = 0; at < id.size();) {
    const auto [c, bytes] = character_at(id, at);
    const bool is_good = is_in(c, kStarts) || (at > 0 && is_in(c, kFurther));
    const bool is_ours =
        (at == 0 && (id.starts_with(kMadeId) || id == kEmptyId)) || (c == '_' && escape_at(id, at));
    if (is_good && !is_ours)
      result += id.substr(at, bytes);
    else
      result += fmt::format("_x{:04X}_", static_cast<std::uint32_t>(c));
    at += bytes;
  }
  return result;
}

std::string xml_id_source(std::string_view xml_id) {
  std::string result;
  if (xml_id == kEmptyId) return result;
  for (std::size_t at = 0; at < xml_id.size();) {
    const auto escape = escape_at(xml_id, at);
    const Character here = escape ? *escape : character_at(xml_id, at);
    if (escape)
      append_utf8(result, here.number);
    else
      result += xml_id.substr(at, here.bytes);
    at += here.bytes;
  }
  return result;
}

}  // namespace oriel::detail
