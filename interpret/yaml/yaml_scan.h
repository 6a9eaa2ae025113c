#pragma once

#include "interpret/yaml/yaml_fault.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace oriel::rules {

inline constexpr std::size_t kNowhere = std::string_view::npos;

bool is_blank_character(char c);

/// The word at the start of `text`, and the one at its end.
std::string_view first_word(std::string_view text);
std::string_view last_word(std::string_view text);

std::string_view without_blanks_at_end(std::string_view text);

/// Reads a text that may be no YAML, line by line: the line at hand, what stands in it, and the
/// first fault. Places are offsets in the text.
struct YamlScan {
  std::string_view text;
  std::size_t begin = 0;  ///< of the line at hand
  std::size_t end = 0;
  std::size_t open_quote = kNowhere;  ///< of a text that goes on on the next line
  std::optional<YamlFault> fault;

  explicit YamlScan(std::string_view read) : text(read) {}

  /// Makes the line at `from` that at hand.
  void go_to_line(std::size_t from);
  [[nodiscard]] std::size_t next_line() const;
  [[nodiscard]] std::string_view line() const { return text.substr(begin, end - begin); }
  [[nodiscard]] std::size_t skip_blanks(std::size_t at) const;
  [[nodiscard]] bool is_comment(std::size_t at) const;
  [[nodiscard]] bool is_at_end(std::size_t at) const { return at >= end || is_comment(at); }
  [[nodiscard]] bool is_blank_line() const { return is_at_end(skip_blanks(begin)); }
  [[nodiscard]] bool is_colon(std::size_t at) const;
  /// The end of the text that begins at `from`: before a comment and blanks.
  [[nodiscard]] std::size_t text_end(std::size_t from) const;
  /// The first colon that ends a key, or kNowhere.
  [[nodiscard]] std::size_t find_colon(std::size_t from, std::size_t before) const;

  void report(SourceSpan where, std::string sentence);
  /// The same with the line around `replaced`, mended: what stands there is replaced.
  void report(SourceSpan where, std::string sentence, SourceSpan replaced, std::string_view by);
};

}  // namespace oriel::rules
