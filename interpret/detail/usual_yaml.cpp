#include "interpret/detail/usual_yaml.h"

#include "interpret/detail/yaml_tree.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/mark.h>

namespace oriel::rules {

namespace {

/// Keys that are longer mean something else to yaml-cpp.
constexpr std::size_t kLongestKey = 512;

/// Sets of bytes, for tests that every byte of a text is put to.
class Bytes {
 public:
  constexpr explicit Bytes(std::string_view members) {
    for (const char c : members) is_in_[static_cast<unsigned char>(c)] = true;
  }
  constexpr Bytes with(char first, char last) const {
    Bytes all = *this;
    for (auto c = static_cast<unsigned>(static_cast<unsigned char>(first));
         c <= static_cast<unsigned char>(last); ++c)
      all.is_in_[c] = true;
    return all;
  }
  [[nodiscard]] constexpr bool has(char c) const { return is_in_[static_cast<unsigned char>(c)]; }

 private:
  std::array<bool, 256> is_in_{};
};

constexpr Bytes kWordBytes = Bytes("_").with('0', '9').with('a', 'z').with('A', 'Z');
/// With these a plain scalar begins that cannot be anything else.
constexpr Bytes kPlainBegins = Bytes("_$(<=").with('0', '9').with('a', 'z').with('A', 'Z').with(
    static_cast<char>(0x80), static_cast<char>(0xFF));
/// Control characters, tabs and line ends of other systems among them.
constexpr Bytes kUnusual = Bytes("\t\r\x7F").with(0x00, 0x09).with(0x0B, 0x1F);
/// What may end a plain scalar, in lines and in brackets.
constexpr Bytes kMayEndInLine = Bytes(":#\n");
constexpr Bytes kMayEndInBrackets = Bytes(":#\n,[]{}?");

/// A scalar in the text; with its quotes it stands at begin .. end.
struct Scalar {
  std::size_t begin;
  std::size_t end;
  std::string_view text;
  bool is_plain;
};

/// Every function that returns a bool returns false where it meets what is not usual.
class UsualYaml {
 public:
  UsualYaml(std::string_view text, YAML::EventHandler& events) : text_(text), events_(events) {}

  bool run() {
    if (std::ranges::any_of(text_, [](char c) { return kUnusual.has(c); })) return false;
    // A byte order mark, of whatever encoding.
    if (static_cast<unsigned char>(peek(0)) >= 0x80) return false;
    if (!skip_lines() || column() != 0) return false;
    events_.OnDocumentStart(mark(at_));
    if (!block_map(0) || at_ < text_.size()) return false;
    events_.OnDocumentEnd();
    return true;
  }

 private:
  [[nodiscard]] char peek(std::size_t at) const { return at < text_.size() ? text_[at] : '\n'; }
  [[nodiscard]] bool is_blank_at(std::size_t at) const {
    return peek(at) == ' ' || peek(at) == '\n';
  }
  [[nodiscard]] std::size_t column() const { return at_ - line_; }
  [[nodiscard]] bool is_item() const { return peek(at_) == '-' && is_blank_at(at_ + 1); }
  static YAML::Mark mark(std::size_t at) {
    YAML::Mark mark;
    mark.pos = static_cast<int>(at);
    return mark;
  }

  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  /// Over blanks and a comment; true at the end of the line.
  bool skip_rest_of_line() {
    const std::size_t begin = at_;
    skip_blanks();
    if (peek(at_) == '#') {
      if (at_ == begin && at_ > line_) return false;
      at_ = std::min(text_.find('\n', at_), text_.size());
    }
    return peek(at_) == '\n';
  }
  /// To what comes next; false at the end of the text.
  bool skip_lines() {
    while (skip_rest_of_line()) {
      if (at_ >= text_.size()) return false;
      line_ = ++at_;
    }
    return at_ < text_.size();
  }
  /// The same for what belongs to the lines that begin at `column`: further right.
  bool skip_lines_beyond(std::size_t column_of_parent) {
    return skip_lines() && column() > column_of_parent;
  }

  [[nodiscard]] std::optional<Scalar> scalar(bool is_in_brackets) const;
  [[nodiscard]] std::optional<Scalar> plain_scalar(bool is_in_brackets) const;
  [[nodiscard]] std::optional<Scalar> quoted_scalar() const;
  void tell(const Scalar& scalar) {
    events_.OnScalar(mark(scalar.begin), scalar.is_plain ? "?" : "!", 0, std::string(scalar.text));
  }

  /// A key and its colon, which a blank follows.
  bool key(bool is_in_brackets);
  [[nodiscard]] bool is_key() const {
    const auto found = scalar(false);
    return found && peek(text_.find_first_not_of(' ', found->end)) == ':';
  }
  bool block_node();
  bool block_map(std::size_t column_of_keys);
  bool block_list(std::size_t column_of_items);
  bool value_of_key(std::size_t column_of_keys);
  bool item(std::size_t column_of_items);
  bool value_in_line(std::size_t column_of_parent);
  bool in_brackets(std::size_t column_of_parent);
  bool entry(bool is_map, std::size_t column_of_parent);

  std::string_view text_;
  YAML::EventHandler& events_;
  std::size_t at_ = 0;
  /// Where the line begins that `at_` is in.
  std::size_t line_ = 0;
  std::size_t depth_ = 0;
};

std::optional<Scalar> UsualYaml::scalar(bool is_in_brackets) const {
  const char first = peek(at_);
  if (first == '"' || first == '\'') return quoted_scalar();
  const bool is_negative = first == '-' && kWordBytes.has(peek(at_ + 1));
  if (!kPlainBegins.has(first) && !is_negative) return std::nullopt;
  return plain_scalar(is_in_brackets);
}

/// On one line; what continues on the next is found out by what follows.
std::optional<Scalar> UsualYaml::plain_scalar(bool is_in_brackets) const {
  const Bytes& may_end = is_in_brackets ? kMayEndInBrackets : kMayEndInLine;
  std::size_t end = at_;
  for (;; ++end) {
    while (end < text_.size() && !may_end.has(text_[end])) ++end;
    const char c = peek(end);
    if (c == '#' && text_[end - 1] != ' ') continue;
    if (c != ':' || is_blank_at(end + 1)) break;
    if (is_in_brackets && kMayEndInBrackets.has(peek(end + 1))) return std::nullopt;
  }
  while (text_[end - 1] == ' ') --end;
  const std::string_view text = text_.substr(at_, end - at_);
  if (text == "null" || text == "Null" || text == "NULL") return std::nullopt;
  return Scalar{at_, end, text, true};
}

std::optional<Scalar> UsualYaml::quoted_scalar() const {
  const char quote = text_[at_];
  const std::size_t begin = at_ + 1;
  std::size_t end = begin;
  while (peek(end) != quote && peek(end) != '\n' && !(quote == '"' && text_[end] == '\\')) ++end;
  // Twice a quote is an escape.
  if (peek(end) != quote || peek(end + 1) == quote) return std::nullopt;
  return Scalar{at_, end + 1, text_.substr(begin, end - begin), false};
}

bool UsualYaml::key(bool is_in_brackets) {
  const auto found = scalar(is_in_brackets);
  if (!found || found->text.size() > kLongestKey) return false;
  tell(*found);
  at_ = found->end;
  skip_blanks();
  if (peek(at_) != ':' || !is_blank_at(at_ + 1)) return false;
  ++at_;
  return true;
}

/// What begins on a line of its own.
bool UsualYaml::block_node() { return is_item() ? block_list(column()) : block_map(column()); }

bool UsualYaml::block_map(std::size_t column_of_keys) {
  if (++depth_ > kMostYamlDepth) return false;
  events_.OnMapStart(mark(at_), "?", 0, YAML::EmitterStyle::Block);
  do {
    if (is_item() || !key(false) || !value_of_key(column_of_keys)) return false;
    // What is further right would continue the value.
    if (skip_lines() && column() > column_of_keys) return false;
  } while (at_ < text_.size() && column() == column_of_keys && !is_item());
  --depth_;
  events_.OnMapEnd();
  return true;
}

/// On the line of the key, or below it and further right; a list may begin below the key itself.
bool UsualYaml::value_of_key(std::size_t column_of_keys) {
  if (!skip_rest_of_line()) return value_in_line(column_of_keys);
  if (!skip_lines()) return false;
  if (column() == column_of_keys && is_item()) return block_list(column_of_keys);
  return column() > column_of_keys && block_node();
}

bool UsualYaml::block_list(std::size_t column_of_items) {
  if (++depth_ > kMostYamlDepth) return false;
  events_.OnSequenceStart(mark(at_), "?", 0, YAML::EmitterStyle::Block);
  do {
    ++at_;
    if (!item(column_of_items)) return false;
    if (skip_lines() && column() > column_of_items) return false;
  } while (at_ < text_.size() && column() == column_of_items && is_item());
  --depth_;
  events_.OnSequenceEnd();
  return true;
}

/// A map may begin behind the dash, and so may a list.
bool UsualYaml::item(std::size_t column_of_items) {
  if (skip_rest_of_line()) return skip_lines_beyond(column_of_items) && block_node();
  if (is_item()) return block_list(column());
  return is_key() ? block_map(column()) : value_in_line(column_of_items);
}

/// What stands behind a key or a dash, and nothing but a comment behind it.
bool UsualYaml::value_in_line(std::size_t column_of_parent) {
  if (peek(at_) == '[' || peek(at_) == '{') {
    if (!in_brackets(column_of_parent)) return false;
  } else {
    const auto value = scalar(false);
    if (!value) return false;
    tell(*value);
    at_ = value->end;
  }
  return skip_rest_of_line();
}

bool UsualYaml::in_brackets(std::size_t column_of_parent) {
  if (++depth_ > kMostYamlDepth) return false;
  const bool is_map = text_[at_] == '{';
  const char closing = is_map ? '}' : ']';
  if (is_map)
    events_.OnMapStart(mark(at_), "?", 0, YAML::EmitterStyle::Flow);
  else
    events_.OnSequenceStart(mark(at_), "?", 0, YAML::EmitterStyle::Flow);
  ++at_;
  if (!skip_lines_beyond(column_of_parent)) return false;
  while (text_[at_] != closing) {
    if (!entry(is_map, column_of_parent) || !skip_lines_beyond(column_of_parent)) return false;
    if (text_[at_] == closing) break;
    if (text_[at_] != ',') return false;
    ++at_;
    if (!skip_lines_beyond(column_of_parent) || text_[at_] == closing) return false;
  }
  ++at_;
  --depth_;
  if (is_map)
    events_.OnMapEnd();
  else
    events_.OnSequenceEnd();
  return true;
}

/// An item or a key with its value, up to what follows it.
bool UsualYaml::entry(bool is_map, std::size_t column_of_parent) {
  if (is_map && (!key(true) || !skip_lines_beyond(column_of_parent))) return false;
  if (text_[at_] == '[' || text_[at_] == '{') return in_brackets(column_of_parent);
  const auto value = scalar(true);
  if (!value) return false;
  tell(*value);
  at_ = value->end;
  return true;
}

}  // namespace

bool read_usual_yaml(std::string_view text, YAML::EventHandler& events) {
  return UsualYaml(text, events).run();
}

}  // namespace oriel::rules
