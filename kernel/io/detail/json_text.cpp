#include "kernel/io/detail/json_text.h"

#include "kernel/io/detail/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

template <class Number>
void append_number(std::string& out, Number number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  out.append(digits.data(), end);
}

bool is_escaped(char c) { return c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20U; }

/// `text` with every byte that is no UTF-8 replaced by U+FFFD.
std::string repaired(std::string_view text) {
  std::string result;
  while (const auto bad = find_non_utf8(text)) {
    result.append(text.substr(0, *bad)).append("\xEF\xBF\xBD");
    text.remove_prefix(*bad + 1);
  }
  return result.append(text);
}

}  // namespace

void append_json(std::string& out, std::string_view text) {
  if (find_non_utf8(text)) return append_json(out, std::string_view(repaired(text)));
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

}  // namespace oriel::detail
