#include "interpret/yaml/yaml_scan.h"

#include <algorithm>
#include <utility>

namespace oriel::rules {

namespace {

/// A mended line that is longer than this is not shown in a message.
constexpr std::size_t kLongestMendedLine = 200;

bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

}  // namespace

bool is_blank_character(char c) { return c == ' ' || c == '\t'; }

std::string_view first_word(std::string_view text) {
  const auto end = std::ranges::find_if_not(text, is_word_character);
  return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

std::string_view last_word(std::string_view text) {
  std::size_t begin = text.size();
  while (begin > 0 && is_word_character(text[begin - 1])) --begin;
  return text.substr(begin);
}

std::string_view without_blanks_at_end(std::string_view text) {
  while (!text.empty() && is_blank_character(text.back())) text.remove_suffix(1);
  return text;
}

void YamlScan::go_to_line(std::size_t from) {
  begin = from;
  end = std::min(text.find('\n', begin), text.size());
  if (end > begin && text[end - 1] == '\r') --end;
}

std::size_t YamlScan::next_line() const {
  const std::size_t line_end = text.find('\n', begin);
  return line_end == kNowhere ? text.size() : line_end + 1;
}

std::size_t YamlScan::skip_blanks(std::size_t at) const {
  while (at < end && is_blank_character(text[at])) ++at;
  return at;
}

bool YamlScan::is_comment(std::size_t at) const {
  return at < end && text[at] == '#' && (at == begin || is_blank_character(text[at - 1]));
}

bool YamlScan::is_colon(std::size_t at) const {
  return at < end && text[at] == ':' && (at + 1 == end || is_blank_character(text[at + 1]));
}

std::size_t YamlScan::text_end(std::size_t from) const {
  std::size_t at = from;
  while (at < end && !is_comment(at)) ++at;
  return from + without_blanks_at_end(text.substr(from, at - from)).size();
}

std::size_t YamlScan::find_colon(std::size_t from, std::size_t before) const {
  for (std::size_t at = from; at < before; ++at)
    if (is_colon(at)) return at;
  return kNowhere;
}

void YamlScan::report(SourceSpan where, std::string sentence) {
  if (!fault) fault = {where, std::move(sentence)};
}

void YamlScan::report(SourceSpan where, std::string sentence, SourceSpan replaced,
                      std::string_view by) {
  const std::size_t line_begin = replaced.begin == 0 ? 0 : text.rfind('\n', replaced.begin - 1) + 1;
  const std::size_t line_end = std::min(text.find('\n', replaced.end), text.size());
  std::string mended(text.substr(line_begin, replaced.begin - line_begin));
  mended += by;
  mended += text.substr(replaced.end, line_end - replaced.end);
  if (mended.ends_with('\r')) mended.pop_back();
  if (mended.size() <= kLongestMendedLine) sentence += "; write '" + mended + "'";
  report(where, std::move(sentence));
}

}  // namespace oriel::rules
