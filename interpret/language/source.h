#pragma once

#include "kernel/base/issue.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// A piece of a pack's text: byte offsets [begin, end).
struct SourceSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
  friend constexpr auto operator<=>(SourceSpan, SourceSpan) = default;
};

/// The text of a pack, and of those that it extends, and what is needed to point into it.
class Source {
 public:
  Source(std::string file, std::string text);

  /// Adds the text of another file; returns where it stands in text(). What text_of() gave before
  /// is no longer valid.
  SourceSpan append(std::string file, const std::string& text);

  /// Of the first file.
  [[nodiscard]] const std::string& file() const { return files_.front().name; }
  /// Of all files, in the order of their texts.
  [[nodiscard]] std::vector<std::string> files() const;
  /// Of all files, one after the other.
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::string_view text_of(SourceSpan span) const;
  /// True if `offset` is in the text of the first file.
  [[nodiscard]] bool is_in_first(std::size_t offset) const;

  /// File, line and column of an offset, counted from 1; columns count characters, not bytes.
  [[nodiscard]] Place place(std::size_t offset) const;

  /// The line of `span` and below it a caret under its first character, drawn out with `~` to its
  /// last on that line. Long lines are cut around the caret.
  [[nodiscard]] std::string excerpt(SourceSpan span) const;

 private:
  struct File {
    std::string name;
    std::size_t begin = 0;
    std::size_t first_line = 0;
  };
  [[nodiscard]] const File& file_at(std::size_t offset) const;
  [[nodiscard]] std::size_t line_of(std::size_t offset) const;
  [[nodiscard]] std::string_view line_text(std::size_t line) const;

  std::vector<File> files_;
  std::string text_;
  std::vector<std::size_t> line_starts_;
};

/// The offset of the first byte that is no UTF-8, or that is a control character other than tab and
/// line end; npos if there is none.
std::size_t find_bad_byte(std::string_view text);

}  // namespace oriel::rules
