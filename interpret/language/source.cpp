#include "interpret/language/source.h"

#include "kernel/base/text/printable.h"

#include <algorithm>
#include <utility>

namespace oriel::rules {

namespace {

/// An excerpt shows no more than this many characters before the caret, and in all.
constexpr std::size_t kCharactersBefore = 80;
constexpr std::size_t kCharactersShown = 120;

bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

std::size_t count_characters(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, starts_character));
}

/// The byte at which character number `count` starts, or the end.
std::size_t skip_characters(std::string_view text, std::size_t count) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!starts_character(text[i])) continue;
    if (count == 0) return i;
    --count;
  }
  return text.size();
}

/// `text` as blanks of the same width; tabs stay tabs.
std::string as_blanks(std::string_view text) {
  std::string blanks;
  for (const char c : text)
    if (starts_character(c)) blanks += c == '\t' ? '\t' : ' ';
  return blanks;
}

}  // namespace

Source::Source(std::string file, std::string text) { append(std::move(file), text); }

SourceSpan Source::append(std::string file, const std::string& text) {
  if (!files_.empty()) text_ += '\n';
  const std::size_t begin = text_.size();
  files_.push_back({std::move(file), begin, line_starts_.size()});
  text_ += text;
  line_starts_.push_back(begin);
  for (std::size_t i = begin; i < text_.size(); ++i)
    if (text_[i] == '\n') line_starts_.push_back(i + 1);
  return {begin, text_.size()};
}

const Source::File& Source::file_at(std::size_t offset) const {
  const auto next = std::ranges::upper_bound(files_, offset, {}, &File::begin);
  return *(next - 1);
}

bool Source::is_in_first(std::size_t offset) const { return &file_at(offset) == files_.data(); }

std::vector<std::string> Source::files() const {
  std::vector<std::string> names;
  for (const File& file : files_) names.push_back(file.name);
  return names;
}

std::string_view Source::text_of(SourceSpan span) const {
  return std::string_view(text_).substr(span.begin, span.end - span.begin);
}

std::size_t Source::line_of(std::size_t offset) const {
  const auto next = std::ranges::upper_bound(line_starts_, offset);
  return static_cast<std::size_t>(next - line_starts_.begin()) - 1;
}

std::string_view Source::line_text(std::size_t line) const {
  std::string_view rest = std::string_view(text_).substr(line_starts_[line]);
  rest = rest.substr(0, rest.find('\n'));
  if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
  return rest;
}

Place Source::place(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const std::size_t line = line_of(offset);
  const std::size_t start = line_starts_[line];
  const std::size_t before = count_characters(text_of({start, offset}));
  Place place;
  const File& file = file_at(offset);
  place.file = file.name;
  place.line = static_cast<int>(line - file.first_line) + 1;
  place.column = static_cast<int>(before) + 1;
  return place;
}

std::string Source::excerpt(SourceSpan span) const {
  const std::size_t begin = std::min(span.begin, text_.size());
  const std::size_t line = line_of(begin);
  std::string_view shown = line_text(line);
  std::size_t at = std::min(begin - line_starts_[line], shown.size());
  const std::size_t before = count_characters(shown.substr(0, at));
  if (before > kCharactersBefore) {
    const std::size_t cut = skip_characters(shown, before - kCharactersBefore);
    shown.remove_prefix(cut);
    at -= cut;
  }
  shown = shown.substr(0, skip_characters(shown, kCharactersShown));
  at = std::min(at, shown.size());
  const std::size_t length = span.end > begin ? span.end - begin : 0;
  const std::size_t width = count_characters(shown.substr(at, length));
  const std::string tail = width > 1 ? std::string(width - 1, '~') : "";
  return std::string(shown) + "\n" + as_blanks(shown.substr(0, at)) + "^" + tail;
}

std::size_t find_bad_byte(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool is_control = byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r';
    const std::size_t size = is_control || byte == 0x7F ? 0 : utf8_length(text, i);
    if (size == 0) return i;
    i += size;
  }
  return std::string_view::npos;
}

}  // namespace oriel::rules
