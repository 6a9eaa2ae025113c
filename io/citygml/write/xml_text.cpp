#include "io/citygml/write/xml_text.h"

#include "kernel/base/text/printable.h"
#include "kernel/base/text/xml.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <utf8.h>

namespace oriel::detail {

namespace {

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
  const std::size_t bytes = utf8_length(text, at);
  if (bytes == 0) return {kReplaced, 1};
  return {utf8::unchecked::peek_next(text.data() + at), bytes};
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

void append_element(std::string& out, std::string_view name, std::string_view text,
                    std::string_view attributes) {
  out += '<';
  out += name;
  out += attributes;
  out += '>';
  out += escaped_xml(text);
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
      utf8::unchecked::append(here.number, std::back_inserter(result));
    else
      result += xml_id.substr(at, here.bytes);
    at += here.bytes;
  }
  return result;
}

}  // namespace oriel::detail
