#include "io/json/json_check.h"

#include "io/files/input.h"
#include "io/json/raw_json.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel {

namespace {

constexpr std::string_view kSpace = " \t\r\n";

/// What a file starts with that is not JSON.
std::string_view known_kind(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kKinds{{
      {"\x89PNG", "a PNG image"},
      {"\xFF\xD8\xFF", "a JPEG image"},
      {"PK\x03\x04", "a ZIP archive"},
      {"\x1F\x8B", "a gzip archive"},
      {"%PDF", "a PDF document"},
      {"<", "XML or HTML"},
  }};
  for (const auto& [start, kind] : kKinds)
    if (text.starts_with(start)) return kind;
  return "";
}

Fault no_object(std::string_view text) {
  const std::string_view kind = known_kind(text);
  const std::string found = kind.empty() ? "starts with " + in_quotes(text.substr(0, 8))
                                         : "looks like " + std::string(kind);
  return {Code::E107, found + "; expected a CityJSON object, which starts with '{'"};
}

/// The offset of the first bracket that opens a level below kMaxDepth.
std::optional<std::size_t> find_too_deep(std::string_view text) {
  std::size_t depth = 0;
  bool is_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_string && c == '\\') ++i;
    if (c == '"') is_string = !is_string;
    if (is_string) continue;
    if ((c == '{' || c == '[') && ++depth > kMaxDepth) return i;
    if ((c == '}' || c == ']') && depth > 0) --depth;
  }
  return std::nullopt;
}

/// Listens to nlohmann's parser for where it stops and why; keeps no values.
class ErrorListener : public nlohmann::json::json_sax_t {
 public:
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }

  /// A whole number that comes here did not fit 64 bits.
  bool number_float(number_float_t, const string_t& token) override {
    if (token.find_first_of(".eE") == std::string::npos && big_number.empty()) big_number = token;
    return true;
  }

  bool parse_error(std::size_t at, const std::string& token,
                   const nlohmann::json::exception& error) override {
    position = at > 0 ? at - 1 : 0;
    if (dynamic_cast<const nlohmann::json::out_of_range*>(&error) != nullptr) big_number = token;
    reason = error.what();
    return false;
  }

  std::optional<std::size_t> position;
  std::string reason;
  std::string big_number;
};

/// The part of nlohmann's message that says what was found and expected.
std::string reason_of(std::string message) {
  const std::size_t start = message.find("syntax error");
  if (start != std::string::npos) message.erase(0, start);
  const std::size_t last = message.find("; last read");
  if (last != std::string::npos) {
    const std::size_t expected = message.find("; expected", last);
    const std::string tail = expected == std::string::npos ? "" : message.substr(expected);
    message.erase(last);
    message += tail;
  }
  return message;
}

Issue number_error(const TextName& name, std::string_view text, const std::string& number) {
  return error_at(
      name, text, text.find(number),
      {Code::E504,
       fmt::format("the number {} is out of range; numbers must fit 64 bits", in_quotes(number))});
}

/// True if `tail`, which starts with a byte that is not UTF-8, is a character cut off by the end.
bool is_cut_character(std::string_view tail) {
  const auto is_continuation = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
  };
  return static_cast<unsigned char>(tail.front()) >= 0xC2U && tail.size() < 4 &&
         std::all_of(tail.begin() + 1, tail.end(), is_continuation);
}

std::optional<Issue> find_syntax_error(const TextName& name, std::string_view text) {
  ErrorListener listener;
  nlohmann::json::sax_parse(text.begin(), text.end(), &listener);
  if (!listener.big_number.empty()) return number_error(name, text, listener.big_number);
  if (!listener.position) return std::nullopt;
  const std::size_t end = text.find_last_not_of(kSpace) + 1;
  if (*listener.position >= end)
    return error_at(
        name, text, end,
        {Code::E105, "the text ends in the middle of the JSON object: it is truncated"});
  return error_at(name, text, *listener.position,
                  {Code::E104, "not valid JSON: " + reason_of(listener.reason)});
}

/// What is wrong with a text that should be JSON of whatever kind.
std::optional<Issue> find_text_error(const TextName& name, std::string_view text) {
  if (const auto deep = find_too_deep(text))
    return error_at(name, text, *deep,
                    {Code::E503, fmt::format("nested deeper than {} levels", kMaxDepth)});
  const auto bad = find_non_utf8(text);
  if (bad && !is_cut_character(text.substr(*bad)))
    return error_at(name, text, *bad,
                    {Code::E103, fmt::format("byte 0x{:02X} is not UTF-8; JSON must be UTF-8",
                                             static_cast<unsigned char>(text[*bad]))});
  return find_syntax_error(name, text);
}

}  // namespace

std::optional<Issue> find_json_error(const TextName& name, std::string_view text) {
  const std::size_t start = text.find_first_not_of(kSpace);
  if (start == std::string_view::npos)
    return error_in(name, {Code::E102, "the file is empty; expected a CityJSON object"});
  if (text[start] != '{') return error_at(name, text, start, no_object(text.substr(start)));
  return find_text_error(name, text);
}

std::optional<nlohmann::json> parse_slowly(const TextName& name, std::string_view text,
                                           std::vector<Issue>& issues) {
  std::optional<Issue> issue;
  if (text.find_first_not_of(kSpace) == std::string_view::npos)
    issue = error_in(name, {Code::E102, "the file is empty; expected JSON"});
  else
    issue = find_text_error(name, text);
  if (!issue) return nlohmann::json::parse(text);
  issues.push_back(std::move(*issue));
  return std::nullopt;
}

nlohmann::json read_json_file(const std::string& path) {
  std::vector<Issue> issues;
  auto json = parse_slowly({path}, Input(path).read_all(), issues);
  if (!json) throw InputError(std::move(issues[0]));
  return std::move(*json);
}

std::string decoded(std::string_view raw) {
  if (raw.size() < 2) return std::string(raw);
  const std::string_view inside = raw.substr(1, raw.size() - 2);
  if (inside.find('\\') == std::string_view::npos) return std::string(inside);
  const nlohmann::json value = nlohmann::json::parse(raw, nullptr, false);
  return value.is_string() ? value.get<std::string>() : std::string(inside);
}

}  // namespace oriel
