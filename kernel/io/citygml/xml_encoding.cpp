#include "kernel/io/citygml/xml_encoding.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <utility>

namespace oriel::detail {

namespace {

/// A byte and its character.
using ByteCharacter = std::pair<unsigned char, int>;

/// Microsoft's code page 1252 where it differs from ISO-8859-1: 0x80 to 0x9F, five of them unused.
constexpr std::array<ByteCharacter, 32> kWindows1252{
    {{0x80, 0x20AC}, {0x81, -1},     {0x82, 0x201A}, {0x83, 0x0192}, {0x84, 0x201E}, {0x85, 0x2026},
     {0x86, 0x2020}, {0x87, 0x2021}, {0x88, 0x02C6}, {0x89, 0x2030}, {0x8A, 0x0160}, {0x8B, 0x2039},
     {0x8C, 0x0152}, {0x8D, -1},     {0x8E, 0x017D}, {0x8F, -1},     {0x90, -1},     {0x91, 0x2018},
     {0x92, 0x2019}, {0x93, 0x201C}, {0x94, 0x201D}, {0x95, 0x2022}, {0x96, 0x2013}, {0x97, 0x2014},
     {0x98, 0x02DC}, {0x99, 0x2122}, {0x9A, 0x0161}, {0x9B, 0x203A}, {0x9C, 0x0153}, {0x9D, -1},
     {0x9E, 0x017E}, {0x9F, 0x0178}}};

/// ISO-8859-15 where it differs from ISO-8859-1.
constexpr std::array<ByteCharacter, 8> kLatin9{{{0xA4, 0x20AC},
                                                {0xA6, 0x0160},
                                                {0xA8, 0x0161},
                                                {0xB4, 0x017D},
                                                {0xB8, 0x017E},
                                                {0xBC, 0x0152},
                                                {0xBD, 0x0153},
                                                {0xBE, 0x0178}}};

/// ISO-8859-1, whose bytes are Unicode's first characters, but for `differences`.
ByteTable latin1_but(std::span<const ByteCharacter> differences) {
  ByteTable table{};
  std::iota(table.begin(), table.end(), 0);
  for (const auto& [byte, character] : differences) table[byte] = character;
  return table;
}

std::string plain_name(std::string_view encoding) {
  std::string name(encoding);
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (c == '_') c = '-';
  }
  return name;
}

}  // namespace

std::optional<ByteTable> byte_table_of(std::string_view encoding) {
  const std::string name = plain_name(encoding);
  const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
  };
  if (is_one_of({"windows-1252", "cp1252", "cp-1252", "x-cp1252"})) return latin1_but(kWindows1252);
  if (is_one_of({"iso-8859-15", "iso8859-15", "latin-9", "latin9"})) return latin1_but(kLatin9);
  if (is_one_of({"latin1", "latin-1", "l1", "iso8859-1", "cp819"})) return latin1_but({});
  return std::nullopt;
}

}  // namespace oriel::detail
