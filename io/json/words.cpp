#include "io/json/words.h"

#include <algorithm>
#include <charconv>

namespace oriel::detail {

namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";

template <class Number>
std::optional<Number> parse_number(std::string_view word) {
  if (word.starts_with('+') && word.size() > 1 && word[1] != '-') word.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

/// Where the comment of the line from `at` starts: a '#' at the line's start or after a blank; else
/// the line's end.
std::size_t comment_start(std::string_view text, std::size_t at) {
  for (std::size_t hash = text.find('#', at); hash < text.size(); hash = text.find('#', hash + 1))
    if (hash == at || kBlanks.find(text[hash - 1]) != std::string_view::npos) return hash;
  return text.size();
}

}  // namespace

void WordReader::skip_blanks() { at_ = std::min(text_.find_first_not_of(kBlanks, at_), line_end_); }

bool WordReader::next_line() {
  while (next_start_ < text_.size()) {
    at_ = next_start_;
    const std::size_t newline = std::min(text_.find('\n', at_), text_.size());
    next_start_ = newline + 1;
    line_end_ = comment_start(text_.substr(0, newline), at_);
    skip_blanks();
    if (at_ < line_end_) return true;
  }
  at_ = line_end_ = offset_ = text_.size();
  return false;
}

std::optional<std::string_view> WordReader::next_word() {
  skip_blanks();
  offset_ = at_;
  if (at_ >= line_end_) return std::nullopt;
  const std::size_t end = std::min(text_.find_first_of(kBlanks, at_), line_end_);
  const std::string_view word = text_.substr(at_, end - at_);
  at_ = end;
  return word;
}

std::string_view WordReader::rest_of_line() {
  skip_blanks();
  const std::string_view rest = text_.substr(at_, line_end_ - at_);
  at_ = line_end_;
  return rest.substr(0, rest.find_last_not_of(kBlanks) + 1);
}

std::optional<double> as_double(std::string_view word) { return parse_number<double>(word); }
std::optional<long long> as_whole(std::string_view word) { return parse_number<long long>(word); }

}  // namespace oriel::detail
