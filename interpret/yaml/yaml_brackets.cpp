#include "interpret/yaml/yaml_brackets.h"

#include "interpret/yaml/known_keys.h"
#include "interpret/yaml/yaml_tree.h"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace oriel::rules {

std::size_t YamlBrackets::read(std::size_t at) {
  while (!scan_->fault) {
    at = scan_->skip_blanks(at);
    if (scan_->is_at_end(at)) return kNowhere;
    at = read_in_brackets(at);
    if (scan_->open_quote != kNowhere) return kNowhere;
    if (brackets_.empty() && !scan_->fault) return at;
  }
  return kNowhere;
}

std::size_t YamlBrackets::read_in_brackets(std::size_t at) {
  const char c = scan_->text[at];
  if (c == '{' || c == '[') return read_open(at);
  if (c == '}' || c == ']') return read_close(at);
  if (c == ',') {
    brackets_.back().begin_entry();
    return at + 1;
  }
  const bool is_after_quote = at > 0 && (scan_->text[at - 1] == '"' || scan_->text[at - 1] == '\'');
  if (scan_->is_colon(at) || (c == ':' && is_after_quote)) return read_colon(at);
  return c == '"' || c == '\'' ? read_quoted(at) : read_plain(at);
}

std::size_t YamlBrackets::read_open(std::size_t at) {
  if (!brackets_.empty()) {
    OpenBracket& outer = brackets_.back();
    if (outer.is_complete && outer.is_plain) {
      const std::size_t end = end_of_entry(at);
      const std::string_view entry =
          without_blanks_at_end(scan_->text.substr(outer.value_begin, end - outer.value_begin));
      scan_->report(
          {at, at + 1},
          fmt::format("'{}' in a text without quotes; in {} a text with brackets or commas "
                      "needs quotes",
                      scan_->text[at], outer.closes_by == ']' ? "[ ]" : "{ }"),
          {outer.value_begin, outer.value_begin + entry.size()}, fmt::format("\"{}\"", entry));
      return at;
    }
    if (outer.is_complete) {
      report_missing_comma(at);
      return at;
    }
    if (outer.value_begin == kNowhere) outer.value_begin = at;
  }
  brackets_.push_back({.offset = at, .closes_by = scan_->text[at] == '{' ? '}' : ']'});
  return at + 1;
}

std::size_t YamlBrackets::read_close(std::size_t at) {
  const OpenBracket closed = brackets_.back();
  if (scan_->text[at] != closed.closes_by) {
    scan_->report({at, at + 1},
                  fmt::format("'{}' is here, but the '{}' before it is still open", scan_->text[at],
                              scan_->text[closed.offset]),
                  {at, at}, std::string(1, closed.closes_by));
    return at;
  }
  brackets_.pop_back();
  if (brackets_.empty()) return at + 1;
  brackets_.back().is_complete = true;
  brackets_.back().is_plain = false;
  brackets_.back().value_end = at + 1;
  return at + 1;
}

std::size_t YamlBrackets::read_quoted(std::size_t at) {
  OpenBracket& bracket = brackets_.back();
  if (bracket.is_complete) {
    report_missing_comma(at);
    return at;
  }
  if (bracket.value_begin == kNowhere) bracket.value_begin = at;
  bracket.is_complete = true;
  bracket.is_plain = false;
  const std::size_t close = find_closing_quote(scan_->text.substr(0, scan_->end), at);
  if (close == kNowhere) {
    scan_->open_quote = at;
    return scan_->end;
  }
  bracket.value_end = close + 1;
  return close + 1;
}

std::size_t YamlBrackets::read_plain(std::size_t at) {
  OpenBracket& bracket = brackets_.back();
  if (bracket.is_complete && !bracket.is_plain) {
    report_missing_comma(at);
    return at;
  }
  if (bracket.value_begin == kNowhere) bracket.value_begin = at;
  bracket.is_complete = bracket.is_plain = true;
  std::size_t end = at;
  while (end < scan_->end && std::string_view(",[]{}").find(scan_->text[end]) == kNowhere &&
         !scan_->is_colon(end) && !scan_->is_comment(end))
    ++end;
  bracket.value_end = at + without_blanks_at_end(scan_->text.substr(at, end - at)).size();
  return std::max(end, at + 1);
}

std::size_t YamlBrackets::read_colon(std::size_t at) {
  OpenBracket& bracket = brackets_.back();
  if (!bracket.has_colon) {
    bracket.has_colon = true;
    bracket.is_complete = false;
    bracket.value_begin = kNowhere;
    return at + 1;
  }
  if (bracket.value_begin == kNowhere || bracket.value_begin < scan_->begin) {
    scan_->report({at, at + 1}, "a second colon in one entry; a comma may be missing before it");
    return at;
  }
  const std::string_view value = scan_->text.substr(bracket.value_begin, at - bracket.value_begin);
  const std::string_view word = last_word(value);
  const std::size_t before =
      without_blanks_at_end(value.substr(0, value.size() - word.size())).size();
  if (before > 0 && is_known_yaml_key(word)) {
    const std::size_t comma = bracket.value_begin + before;
    scan_->report({at - word.size(), at}, fmt::format("a comma is missing before '{}'", word),
                  {comma, comma}, ",");
    return at;
  }
  const std::size_t end = end_of_entry(at);
  const std::string_view entry =
      without_blanks_at_end(scan_->text.substr(bracket.value_begin, end - bracket.value_begin));
  scan_->report({at, at + 1}, "a second colon in one entry; a text with a colon needs quotes",
                {bracket.value_begin, bracket.value_begin + entry.size()},
                fmt::format("\"{}\"", entry));
  return at;
}

/// Where the entry at `at` ends: at a comma or a bracket that closes what is open before it.
std::size_t YamlBrackets::end_of_entry(std::size_t at) const {
  int depth = 0;
  for (; at < scan_->end; ++at) {
    const char c = scan_->text[at];
    if (c == '[' || c == '{') ++depth;
    if ((c == ',' || c == ']' || c == '}') && depth == 0) return at;
    if (c == ']' || c == '}') --depth;
  }
  return scan_->end;
}

void YamlBrackets::report_missing_comma(std::size_t at) {
  const std::size_t end = brackets_.back().value_end;
  const std::size_t line_begin = scan_->text.rfind('\n', at) + 1;
  if (end == kNowhere || end < line_begin)
    scan_->report({at, at + 1}, "a comma is missing at the end of the line above this one");
  else
    scan_->report({at, at + 1}, "a comma is missing before this", {end, end}, ",");
}

void YamlBrackets::report_open(std::size_t end) {
  std::string closers;
  for (auto bracket = brackets_.rbegin(); bracket != brackets_.rend(); ++bracket)
    closers += bracket->closes_by;
  const std::size_t at = brackets_.back().offset;
  scan_->report({at, at + 1},
                fmt::format("the '{}' that opens here is never closed", scan_->text[at]),
                {end, end}, closers);
}

}  // namespace oriel::rules
