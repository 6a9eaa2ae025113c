#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace oriel::detail {

/// Walks through a text line by line and, within a line, word by word. Words are what stands
/// between blanks; a '#' at the start of a word starts a comment that reaches to the line's end.
class WordReader {
 public:
  /// The first line starts at `start`.
  explicit WordReader(std::string_view text, std::size_t start = 0)
      : text_(text), next_start_(start) {}

  /// Moves to the next line that has a word; false at the end of the text.
  bool next_line();
  /// The next word of the line, or nothing at its end.
  std::optional<std::string_view> next_word();
  /// The rest of the line without blanks around it.
  std::string_view rest_of_line();
  /// Where the last word started; the line's end after the last word.
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  void skip_blanks();

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_end_ = 0;
  std::size_t next_start_ = 0;
  std::size_t offset_ = 0;
};

/// The number that the whole word is ("nan" and "inf" too), or nothing.
std::optional<double> as_double(std::string_view word);
/// The whole number that the word is, or nothing.
std::optional<long long> as_whole(std::string_view word);

}  // namespace oriel::detail
