#include "interpret/editing/completion/open_ends.h"

#include "interpret/yaml/yaml_scan.h"
#include "interpret/yaml/yaml_tree.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace oriel::rules {

namespace {

/// Goes through the text from the front; each step returns where to go on, at the latest the end.
class OpenEndFinder {
 public:
  explicit OpenEndFinder(std::string_view text) : scan_(text) {}

  OpenEnds run() {
    for (std::size_t at = 0; at < scan_.text.size();) {
      scan_.go_to_line(at);
      const std::size_t next = read_line();
      at = next > scan_.end || next == scan_.text.size() ? next : scan_.next_line();
    }
    const bool is_new_line = scan_.text.empty() || scan_.text.back() == '\n';
    if (is_new_line && ends_.closers.empty()) ends_.is_value = ends_.is_comment = false;
    return ends_;
  }

 private:
  /// In the line at hand, which begins outside brackets and quotes.
  std::size_t read_line() {
    ends_.is_value = ends_.is_comment = ends_.is_literal = false;
    std::size_t at = scan_.skip_blanks(scan_.begin);
    const std::size_t column = at - scan_.begin;
    if (literal_column_ && (at == scan_.end || column > *literal_column_)) {
      ends_.is_literal = true;
      return scan_.end;
    }
    literal_column_.reset();
    while (at < scan_.end && scan_.text[at] == '-' && is_blank_after(at))
      at = scan_.skip_blanks(at + 1);
    if (scan_.is_at_end(at)) return end_of_line(at);
    at = read_node(at, column);
    if (at >= scan_.end || !scan_.is_colon(at)) return at >= scan_.end ? at : end_of_line(at);
    ends_.is_value = true;
    at = scan_.skip_blanks(at + 1);
    return scan_.is_at_end(at) ? end_of_line(at) : read_node(at, column);
  }

  [[nodiscard]] bool is_blank_after(std::size_t at) const {
    return at + 1 == scan_.end || is_blank_character(scan_.text[at + 1]);
  }

  /// From `at` only blanks and a comment are expected.
  std::size_t end_of_line(std::size_t at) {
    while (at < scan_.end && !scan_.is_comment(at)) ++at;
    ends_.is_comment = at < scan_.end && scan_.end == scan_.text.size();
    return scan_.end;
  }

  /// A key, or a value; up to the colon after a key, the end of brackets, or the end of the line.
  std::size_t read_node(std::size_t at, std::size_t column) {
    const char c = scan_.text[at];
    if (c == '{' || c == '[') return read_brackets(at);
    if (c == '"' || c == '\'') return read_quoted(at);
    if (ends_.is_value && (c == '|' || c == '>')) literal_column_ = column;
    const std::size_t end = scan_.text_end(at);
    const std::size_t colon = ends_.is_value ? kNowhere : scan_.find_colon(at, end);
    return colon == kNowhere ? end_of_line(end) : colon;
  }

  std::size_t read_quoted(std::size_t at) {
    const std::size_t close = find_closing_quote(scan_.text, at);
    if (close == kNowhere) ends_.quote = scan_.text[at];
    if (close == kNowhere) return scan_.text.size();
    if (close >= scan_.end) scan_.go_to_line(scan_.text.rfind('\n', close) + 1);
    return close + 1;
  }

  /// Everything up to the bracket that closes the one at `at`, over lines.
  std::size_t read_brackets(std::size_t at) {
    const bool was_value = ends_.is_value;
    do {
      at = read_in_brackets(at);
    } while (at < scan_.text.size() && !ends_.closers.empty());
    if (ends_.closers.empty()) ends_.is_value = was_value;
    return at;
  }

  std::size_t read_in_brackets(std::size_t at) {
    const char c = scan_.text[at];
    if (c == '\n' || at >= scan_.end) {
      if (scan_.next_line() >= scan_.text.size()) return scan_.text.size();
      scan_.go_to_line(scan_.next_line());
      ends_.is_comment = false;
      return scan_.begin;
    }
    if (is_blank_character(c)) return at + 1;
    if (scan_.is_comment(at)) return end_of_line(at);
    if (c == '{' || c == '[') {
      ends_.closers.insert(ends_.closers.begin(), c == '{' ? '}' : ']');
      ends_.is_value = false;
    } else if (c == '}' || c == ']') {
      ends_.closers.erase(0, 1);
    } else if (c == ',') {
      ends_.is_value = false;
    } else if (scan_.is_colon(at)) {
      ends_.is_value = true;
    } else {
      return c == '"' || c == '\'' ? read_quoted(at) : read_plain(at);
    }
    return at + 1;
  }

  std::size_t read_plain(std::size_t at) {
    ++at;
    while (at < scan_.end && std::string_view(",[]{}").find(scan_.text[at]) == kNowhere &&
           !scan_.is_colon(at) && !scan_.is_comment(at))
      ++at;
    return at;
  }

  YamlScan scan_;
  OpenEnds ends_;
  std::optional<std::size_t> literal_column_;
};

}  // namespace

OpenEnds open_ends_of(std::string_view text) { return OpenEndFinder(text).run(); }

}  // namespace oriel::rules
