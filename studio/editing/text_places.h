#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// A piece of an edited text: byte offsets [begin, end).
struct TextSpan {
  std::size_t begin = 0;
  std::size_t end = 0;
  friend constexpr auto operator<=>(TextSpan, TextSpan) = default;
};

/// A place in an edited text as editors count: lines from 1, columns from 1 in units of UTF-16.
struct TextPlace {
  int line = 1;
  int column = 1;
  friend constexpr auto operator<=>(TextPlace, TextPlace) = default;
};

/// Replaces what stands at `where`.
struct TextEdit {
  TextSpan where{};
  std::string text{};
};

/// `text` with all of the edits, which must not overlap, in whatever order.
std::string with_edits(std::string text, std::vector<TextEdit> edits);

/// Where the lines of a text begin.
class TextPlaces {
 public:
  /// `text` must live as long as this.
  explicit TextPlaces(std::string_view text);

  /// The place of an offset; beyond the end that of the end.
  [[nodiscard]] TextPlace place(std::size_t offset) const;
  /// The offset of a place. Beyond the end of a line or of the text that end is meant, before the
  /// first line or column the first.
  [[nodiscard]] std::size_t offset(TextPlace place) const;
  [[nodiscard]] int line_count() const { return static_cast<int>(starts_.size()); }

 private:
  std::string_view text_;
  std::vector<std::size_t> starts_;
};

}  // namespace oriel
