#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <utf8.h>

namespace oriel {

namespace {

template <class Number>
void append_number(std::string& out, Number number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  out.append(digits.data(), end);
}

bool is_escaped(char c) { return c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20U; }

/// True if all of eight bytes are ASCII and none is escaped. A byte is below n if taking n away
/// borrows from its highest bit.
bool are_plain(const char* bytes) {
  constexpr std::uint64_t kOnes = 0x0101010101010101ULL, kHighest = 0x80 * kOnes;
  std::uint64_t block = 0;
  std::memcpy(&block, bytes, 8);
  const std::uint64_t quotes = block ^ ('"' * kOnes), slashes = block ^ ('\\' * kOnes);
  const std::uint64_t odd = block | (block - ' ' * kOnes) | (quotes - kOnes) | (slashes - kOnes);
  return (odd & kHighest) == 0;
}

/// True if nothing has to be done to a text but to quote it. May be false nevertheless.
bool is_free_of_escapes(std::string_view text) {
  if (text.size() < 8)
    return std::ranges::all_of(
        text, [](char c) { return !is_escaped(c) && static_cast<unsigned char>(c) < 0x80U; });
  for (std::size_t i = 0; i + 8 < text.size(); i += 8)
    if (!are_plain(text.data() + i)) return false;
  return are_plain(text.data() + text.size() - 8);
}

/// `text` with every byte that is no UTF-8 replaced by U+FFFD.
std::string repaired(std::string_view text) {
  std::string result;
  for (std::size_t bad = 0; (bad = utf8::find_invalid(text)) != std::string_view::npos;) {
    result.append(text.substr(0, bad)).append("\xEF\xBF\xBD");
    text.remove_prefix(bad + 1);
  }
  return result.append(text);
}

}  // namespace

void append_json(std::string& out, std::string_view text) {
  if (is_free_of_escapes(text)) {
    const std::size_t start = out.size() + 1;
    out.append(text.size() + 2, '"');
    text.copy(out.data() + start, text.size());
    return;
  }
  if (!utf8::is_valid(text)) return append_json(out, std::string_view(repaired(text)));
  out += '"';
  while (!text.empty()) {
    const auto plain =
        static_cast<std::size_t>(std::ranges::find_if(text, is_escaped) - text.begin());
    out.append(text.substr(0, plain));
    text.remove_prefix(plain);
    if (text.empty()) break;
    if (const char c = text.front(); c == '"' || c == '\\')
      out.append({'\\', c});
    else
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    text.remove_prefix(1);
  }
  out += '"';
}

void append_json(std::string& out, double number) {
  if (std::isfinite(number))
    append_number(out, number);
  else
    out += "null";
}

void append_json(std::string& out, std::int64_t number) { append_number(out, number); }
void append_json(std::string& out, int number) { append_number(out, number); }
void append_json(std::string& out, bool value) { out += value ? "true" : "false"; }

void append_json_key(std::string& out, std::string_view key) {
  if (!out.empty() && out.back() != '{') out += ',';
  append_json(out, key);
  out += ':';
}

std::string shortest(double number) {
  std::string text;
  append_number(text, number);
  return text;
}

}  // namespace oriel

namespace oriel {

std::string json_string(std::string_view text) {
  std::string quoted;
  append_json(quoted, text);
  return quoted;
}

std::string json_number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

}  // namespace oriel
