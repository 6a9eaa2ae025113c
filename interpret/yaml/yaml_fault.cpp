#include "interpret/yaml/yaml_fault.h"

#include "interpret/yaml/yaml_tree.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

constexpr std::size_t kNowhere = std::string_view::npos;

/// A mended line that is longer than this is not shown in a message.
constexpr std::size_t kLongestMendedLine = 200;

// clang-format off
constexpr std::array<std::string_view, 81> kKnownKeys = {
    "abstract", "aggregate", "ambiguous_below", "anchor", "at_least", "because", "by", "class",
    "classes", "company", "decide", "displace", "do", "eaves-m", "emit", "enlarge", "evidence",
    "expect", "extends", "fall", "fixtures", "footprint-pct", "for", "function", "gap",
    "generalise", "given", "ground", "ground_reach", "groups", "hosts", "id", "into", "invariants",
    "is", "iterate", "label", "macros", "min_score", "name", "of", "otherwise", "overhang-pct",
    "pack", "params", "party-walls-pct", "priority", "range", "ratio", "relations", "remove",
    "require", "ridge-m", "rise", "roof", "rounds", "rules", "scale", "schema", "score",
    "surfaces", "symbolise", "tests", "tests_for", "to", "top", "top-m", "type", "typical",
    "typify", "unless", "value", "version", "volume-pct", "wall", "weight", "when", "where", "why",
    "with", "within"};
// clang-format on

bool is_blank_character(char c) { return c == ' ' || c == '\t'; }

bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

bool is_known_key(std::string_view word) {
  return std::ranges::find(kKnownKeys, word) != kKnownKeys.end();
}

std::string count_spaces(std::size_t count) {
  return fmt::format("{} {}", count, count == 1 ? "space" : "spaces");
}

/// The word at the start of `text`.
std::string_view first_word(std::string_view text) {
  const auto end = std::ranges::find_if_not(text, is_word_character);
  return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

/// The word at the end of `text`.
std::string_view last_word(std::string_view text) {
  std::size_t begin = text.size();
  while (begin > 0 && is_word_character(text[begin - 1])) --begin;
  return text.substr(begin);
}

std::string_view without_blanks_at_end(std::string_view text) {
  while (!text.empty() && is_blank_character(text.back())) text.remove_suffix(1);
  return text;
}

/// A map or list in block style that is open: its entries begin in one column.
struct BlockLevel {
  std::size_t column = 0;
  bool is_list = false;
  /// Its last entry has no value on its own line, so that one may follow below it.
  bool has_open_value = false;
  /// What its last entry begins with.
  std::string_view name;
};

/// A { or [ that is open, and what was read of the entry at hand.
struct OpenBracket {
  std::size_t offset = 0;
  char closes_by = '}';
  bool has_colon = false;
  /// A text or bracket has ended: a comma or a colon must follow.
  bool is_complete = false;
  bool is_plain = false;  ///< what has ended is a text without quotes
  std::size_t value_begin = kNowhere;
  std::size_t value_end = kNowhere;

  void begin_entry() {
    has_colon = is_complete = is_plain = false;
    value_begin = value_end = kNowhere;
  }
};

/// Reads a text line by line, as YAML readers do, and stops at the first line that cannot be right.
class YamlFaultFinder {
 public:
  YamlFaultFinder(std::string_view text, std::size_t stop) : text_(text), stop_(stop) {}

  std::optional<YamlFault> run() {
    for (begin_ = 0; begin_ < text_.size() && begin_ <= stop_ && !fault_; begin_ = next_line()) {
      end_ = std::min(text_.find('\n', begin_), text_.size());
      if (end_ > begin_ && text_[end_ - 1] == '\r') --end_;
      check_line();
      if (!is_blank_line() && !fault_) last_line_ = {begin_, end_};
    }
    if (!fault_ && open_quote_ != kNowhere) report_open_quote();
    if (!fault_ && !brackets_.empty() && stop_ >= text_.size()) report_open_bracket();
    return std::move(fault_);
  }

 private:
  [[nodiscard]] std::size_t next_line() const {
    const std::size_t end = text_.find('\n', begin_);
    return end == kNowhere ? text_.size() : end + 1;
  }
  [[nodiscard]] std::string_view line() const { return text_.substr(begin_, end_ - begin_); }
  [[nodiscard]] std::string_view rest_of_line(std::size_t from) const {
    return text_.substr(from, end_ - from);
  }
  [[nodiscard]] std::size_t skip_blanks(std::size_t at) const {
    while (at < end_ && is_blank_character(text_[at])) ++at;
    return at;
  }
  [[nodiscard]] bool is_comment(std::size_t at) const {
    return at < end_ && text_[at] == '#' && (at == begin_ || is_blank_character(text_[at - 1]));
  }
  [[nodiscard]] bool is_at_end(std::size_t at) const { return at >= end_ || is_comment(at); }
  [[nodiscard]] bool is_blank_line() const { return is_at_end(skip_blanks(begin_)); }
  [[nodiscard]] bool is_colon(std::size_t at) const {
    return at < end_ && text_[at] == ':' && (at + 1 == end_ || is_blank_character(text_[at + 1]));
  }
  /// The end of the text that begins at `from`: before a comment and blanks.
  [[nodiscard]] std::size_t text_end(std::size_t from) const {
    std::size_t at = from;
    while (at < end_ && !is_comment(at)) ++at;
    return from + without_blanks_at_end(text_.substr(from, at - from)).size();
  }
  /// The first colon that ends a key, or kNowhere.
  [[nodiscard]] std::size_t find_colon(std::size_t from, std::size_t end) const {
    for (std::size_t at = from; at < end; ++at)
      if (is_colon(at)) return at;
    return kNowhere;
  }

  void report(SourceSpan where, std::string sentence) {
    if (!fault_) fault_ = {where, std::move(sentence)};
  }
  /// The same with the line at `begin`, mended: what is at `where` is replaced.
  void report(SourceSpan where, std::string sentence, SourceSpan replaced, std::string_view by) {
    const std::size_t begin = replaced.begin == 0 ? 0 : text_.rfind('\n', replaced.begin - 1) + 1;
    const std::size_t end = std::min(text_.find('\n', replaced.end), text_.size());
    std::string mended(text_.substr(begin, replaced.begin - begin));
    mended += by;
    mended += text_.substr(replaced.end, end - replaced.end);
    if (mended.ends_with('\r')) mended.pop_back();
    if (mended.size() <= kLongestMendedLine) sentence += "; write '" + mended + "'";
    report(where, std::move(sentence));
  }

  void check_line();
  bool check_tab(std::size_t content);
  [[nodiscard]] std::size_t column_for_tabs(std::size_t content) const;
  void check_block(std::size_t content);
  std::size_t enter_items(std::size_t at);
  void check_entry(std::size_t at, bool is_item);
  void check_value(std::size_t at);
  void check_plain_value(std::size_t at);
  void check_without_colon(std::size_t at, bool is_item);
  void check_after_value(std::size_t value, std::size_t at);
  bool enter(std::size_t at, bool is_list, std::string_view name);
  void report_column(std::size_t at, bool is_list, std::string_view name,
                     const std::vector<BlockLevel>& before);

  void read_brackets(std::size_t value, std::size_t at);
  std::size_t read_in_brackets(std::size_t at);
  std::size_t read_close(std::size_t at);
  std::size_t read_open(std::size_t at);
  std::size_t read_quoted(std::size_t at);
  std::size_t read_plain(std::size_t at);
  std::size_t read_colon(std::size_t at);
  [[nodiscard]] std::size_t end_of_entry(std::size_t at) const;

  void report_open_quote();
  void report_open_bracket();
  void report_missing_comma(std::size_t at);

  std::string_view text_;
  std::size_t stop_;
  std::size_t begin_ = 0;  ///< of the line at hand
  std::size_t end_ = 0;
  std::pair<std::size_t, std::size_t> last_line_{0, 0};
  std::vector<BlockLevel> levels_;
  std::vector<OpenBracket> brackets_;
  std::size_t bracket_column_ = 0;         ///< indentation of the line on which they begin
  std::size_t bracket_value_ = 0;          ///< where the outermost begins
  std::size_t open_quote_ = kNowhere;      ///< of a text that goes on on the next line
  std::size_t literal_column_ = kNowhere;  ///< what stands deeper is of a text after | or >
  std::optional<YamlFault> fault_;
};

void YamlFaultFinder::check_line() {
  std::size_t at = skip_blanks(begin_);
  if (open_quote_ != kNowhere) {
    const std::string_view rest = rest_of_line(begin_);
    std::string quoted(1, text_[open_quote_]);
    quoted += rest;
    const std::size_t close = find_closing_quote(quoted, 0);
    if (close == kNowhere) return;
    at = skip_blanks(begin_ + close);
    if (brackets_.empty() && !is_at_end(at)) return report_open_quote();
    open_quote_ = kNowhere;
    if (!brackets_.empty()) read_brackets(bracket_value_, at);
    return;
  }
  if (is_at_end(at)) return;
  const std::size_t column = at - begin_;
  if (literal_column_ != kNowhere && column > literal_column_) return;
  literal_column_ = kNowhere;
  if (!brackets_.empty()) {
    const bool closes = text_[at] == '}' || text_[at] == ']';
    if (column <= bracket_column_ && !closes) return report_open_bracket();
    return read_brackets(bracket_value_, at);
  }
  if (check_tab(at)) return;
  if (line().starts_with("---") || line().starts_with("...")) return;
  check_block(at);
}

bool YamlFaultFinder::check_tab(std::size_t content) {
  const std::size_t tab = line().find('\t');
  if (tab == kNowhere || begin_ + tab >= content) return false;
  report({begin_ + tab, begin_ + tab + 1},
         "there is a tab before this line; YAML is indented by spaces", {begin_, content},
         std::string(column_for_tabs(content), ' '));
  return true;
}

/// Where what stands after tabs was probably meant to begin.
std::size_t YamlFaultFinder::column_for_tabs(std::size_t content) const {
  std::size_t column = 0;
  for (std::size_t i = begin_; i < content; ++i) column += text_[i] == '\t' ? 2 : 1;
  const bool is_list = text_[content] == '-';
  std::size_t best = column;
  if (!levels_.empty() && levels_.back().has_open_value && !levels_.back().is_list)
    return std::max(column, levels_.back().column + 2);
  std::size_t least = kNowhere;
  for (const BlockLevel& level : levels_) {
    const std::size_t distance = std::max(level.column, column) - std::min(level.column, column);
    if (level.is_list != is_list || distance > least) continue;
    least = distance;
    best = level.column;
  }
  return best;
}

void YamlFaultFinder::check_block(std::size_t content) {
  const std::size_t at = enter_items(content);
  if (fault_ || is_at_end(at)) return;
  check_entry(at, at != content);
}

/// Reads the dashes of list items; returns where what stands after them begins.
std::size_t YamlFaultFinder::enter_items(std::size_t at) {
  while (at < end_ && text_[at] == '-' && (at + 1 == end_ || is_blank_character(text_[at + 1]))) {
    if (!enter(at, true, "-")) return at;
    levels_.back().has_open_value = true;
    at = skip_blanks(at + 1);
  }
  const bool is_glued = at + 1 < end_ && text_[at] == '-' && text_[at + 1] != '-' &&
                        !(text_[at + 1] >= '0' && text_[at + 1] <= '9');
  if (is_glued)
    report({at, at + 1}, "a space is missing after '-', which begins a list item", {at, at + 1},
           "- ");
  return at;
}

void YamlFaultFinder::check_entry(std::size_t at, bool is_item) {
  const char c = text_[at];
  std::size_t colon = kNowhere;
  if (c == '"' || c == '\'') {
    const std::size_t close = find_closing_quote(text_.substr(0, end_), at);
    const std::size_t after = close == kNowhere ? end_ : skip_blanks(close + 1);
    if (is_colon(after)) colon = after;
  } else if (c != '{' && c != '[') {
    colon = find_colon(at, text_end(at));
  }
  if (colon == kNowhere) return check_without_colon(at, is_item);
  const std::string_view key = text_.substr(at, colon - at);
  if (!enter(at, false, key)) return;
  if (const std::size_t brace = key.find(" {"); brace != kNowhere && c != '"' && c != '\'')
    return report({at, at + brace},
                  fmt::format("a colon is missing after '{}'", key.substr(0, brace)),
                  {at + brace, at + brace}, ":");
  const std::size_t value = skip_blanks(colon + 1);
  levels_.back().has_open_value = is_at_end(value);
  if (!is_at_end(value)) check_value(value);
}

void YamlFaultFinder::check_value(std::size_t at) {
  const char c = text_[at];
  if (c == '|' || c == '>') {
    literal_column_ = levels_.empty() ? 0 : levels_.back().column;
  } else if (c == '{' || c == '[') {
    bracket_column_ = skip_blanks(begin_) - begin_;
    bracket_value_ = at;
    read_brackets(at, at);
  } else if (c == '"' || c == '\'') {
    const std::size_t close = find_closing_quote(text_.substr(0, end_), at);
    if (close == kNowhere)
      open_quote_ = at;
    else
      check_after_value(at, close + 1);
  } else {
    check_plain_value(at);
  }
}

void YamlFaultFinder::check_plain_value(std::size_t at) {
  const std::size_t end = text_end(at);
  const std::string_view value = text_.substr(at, end - at);
  const std::string quoted = fmt::format("\"{}\"", value);
  if (value.front() == '%' || value.front() == '@' || value.front() == '`') {
    const bool is_share = value.front() == '%' && value.size() > 1;
    return report(
        {at, at + 1},
        fmt::format("a text cannot begin with '{}' unless it is in quotes{}", value.front(),
                    is_share ? "; the unit % stands after its number" : ""),
        {at, end}, is_share ? fmt::format("{} %", value.substr(1)) : quoted);
  }
  const std::size_t colon = find_colon(at, end);
  if (colon == kNowhere) return;
  const std::string_view word = last_word(text_.substr(at, colon - at));
  if (is_known_key(word) && word.size() < colon - at)
    return report(
        {colon - word.size(), colon},
        fmt::format("a second key, '{}', on one line; it goes on a line of its own", word));
  report({colon, colon + 1}, "a second colon on one line; a text with a colon needs quotes",
         {at, end}, value.find('"') == kNowhere ? quoted : fmt::format("'{}'", value));
}

/// What stands alone: an item of a list, a value below its key, the next line of a text, or a key
/// without its colon.
void YamlFaultFinder::check_without_colon(std::size_t at, bool is_item) {
  const std::size_t end = text_end(at);
  const std::string_view content = text_.substr(at, end - at);
  const std::string_view word = first_word(content);
  const bool has_glued_colon = !word.empty() && word.size() + 1 < content.size() &&
                               content[word.size()] == ':' && is_known_key(word);
  if (has_glued_colon)
    return report({at + word.size(), at + word.size() + 1},
                  fmt::format("a space is missing after '{}:'", word),
                  {at + word.size() + 1, at + word.size() + 1}, " ");
  const auto report_missing_colon = [&] {
    const SourceSpan place{at + word.size(), at + word.size()};
    report({at, at + word.size()}, fmt::format("a colon is missing after '{}'", word), place, ":");
  };
  if (is_item) {
    levels_.back().has_open_value = false;
    const std::size_t next = next_line();
    const std::size_t below = std::min(text_.find_first_not_of(' ', next), text_.size());
    const bool is_key = is_known_key(word) && content.size() > word.size() &&
                        content[word.size()] == ' ' && below - next == at - begin_ &&
                        text_[std::min(below, text_.size() - 1)] != '-';
    return is_key ? report_missing_colon() : check_value(at);
  }
  const std::size_t column = at - begin_;
  while (!levels_.empty() && levels_.back().column > column &&
         std::ranges::find(levels_, column, &BlockLevel::column) != levels_.end())
    levels_.pop_back();
  if (levels_.empty()) return word.empty() ? void() : report_missing_colon();
  BlockLevel& level = levels_.back();
  if (column > level.column) {
    level.has_open_value = false;
    return check_value(at);
  }
  if (column < level.column || level.is_list) return;
  if (level.has_open_value && content.size() > word.size())
    return report(
        {at, end},
        fmt::format("'{}' is what '{}' asks for, and begins in the same column; indent it", content,
                    level.name),
        {at, at}, "  ");
  if (!word.empty()) report_missing_colon();
}

/// What stands after a text in quotes or after brackets must be the end.
void YamlFaultFinder::check_after_value(std::size_t value, std::size_t at) {
  const std::size_t after = skip_blanks(at);
  if (is_at_end(after) || text_[after] == ':') return;
  const std::size_t end = text_end(value);
  std::string mended;
  for (const char c : text_.substr(value, end - value))
    if (c != text_[value]) mended += c;
  const bool is_quoted = text_[value] == '"' || text_[value] == '\'';
  if (!is_quoted && (text_[after] == '}' || text_[after] == ']'))
    return report({after, after + 1},
                  fmt::format("nothing is open that '{}' could close", text_[after]),
                  {after, after + 1}, "");
  if (!is_quoted)
    return report({after, end}, "a list or map in brackets ends here, but the line goes on");
  if (mended.find(": ") != kNowhere || mended.find('#') != kNowhere)
    mended = text_[value] + mended + text_[value];
  report({after, end},
         "the quotes end here, but the line goes on; quotes go round all of it or none",
         {value, end}, mended);
}

/// An entry begins at `at`. False and a fault if none can begin in this column.
bool YamlFaultFinder::enter(std::size_t at, bool is_list, std::string_view name) {
  const std::size_t column = at - begin_;
  const std::vector<BlockLevel> before = levels_;
  while (!levels_.empty() && levels_.back().column > column) levels_.pop_back();
  const bool is_deeper =
      before.size() == levels_.size() &&
      (levels_.empty() ||
       (levels_.back().has_open_value &&
        (levels_.back().column < column || (is_list && !levels_.back().is_list))));
  const bool ends_list = !is_list && levels_.size() > 1 && levels_.back().is_list &&
                         levels_.back().column == column &&
                         levels_[levels_.size() - 2].column == column;
  if (ends_list) levels_.pop_back();
  const bool is_next =
      !levels_.empty() && levels_.back().column == column && levels_.back().is_list == is_list;
  if (is_next) {
    levels_.back().name = name;
    return true;
  }
  if (is_deeper) {
    if (!levels_.empty()) levels_.back().has_open_value = levels_.back().is_list;
    levels_.push_back({column, is_list, false, name});
    return true;
  }
  report_column(at, is_list, name, before);
  return false;
}

void YamlFaultFinder::report_column(std::size_t at, bool is_list, std::string_view name,
                                    const std::vector<BlockLevel>& before) {
  const std::size_t column = at - begin_;
  const auto distance = [&](const BlockLevel& level) {
    return level.column > column ? level.column - column : column - level.column;
  };
  const BlockLevel* nearest = nullptr;
  for (const BlockLevel& level : before)
    if (level.is_list == is_list && (nearest == nullptr || distance(level) <= distance(*nearest)))
      nearest = &level;
  const BlockLevel& last = before.back();
  if (is_list && !last.is_list && last.column <= column)
    return report({at, at + 1},
                  fmt::format("a list begins here, but '{}' has a value on its own line already; "
                              "put that value below it as the first item, '- ...'",
                              last.name));
  if (nearest == nullptr)
    return report(
        {at, at + name.size()},
        fmt::format("'{}' begins a map, but the lines above are items of a list; begin it "
                    "with '- '",
                    name));
  if (nearest->column == column)
    return report({at, at + name.size()},
                  fmt::format("'{}' cannot begin here: what is above it goes on", name));
  const std::string what = is_list ? "this list item" : fmt::format("'{}'", name);
  const std::string above =
      is_list ? "the item above it" : fmt::format("'{}' above it", nearest->name);
  report({at, at + name.size()},
         fmt::format("{} is indented by {}, {} by {}", what, count_spaces(column), above,
                     nearest->column),
         {begin_, at}, std::string(nearest->column, ' '));
}

void YamlFaultFinder::read_brackets(std::size_t value, std::size_t at) {
  while (!fault_) {
    at = skip_blanks(at);
    if (is_at_end(at)) return;
    at = read_in_brackets(at);
    if (open_quote_ != kNowhere) return;
    if (brackets_.empty() && !fault_) return check_after_value(value, at);
  }
}

std::size_t YamlFaultFinder::read_in_brackets(std::size_t at) {
  const char c = text_[at];
  if (c == '{' || c == '[') return read_open(at);
  if (c == '}' || c == ']') return read_close(at);
  if (c == ',') {
    brackets_.back().begin_entry();
    return at + 1;
  }
  const bool is_after_quote = at > 0 && (text_[at - 1] == '"' || text_[at - 1] == '\'');
  if (is_colon(at) || (c == ':' && is_after_quote)) return read_colon(at);
  return c == '"' || c == '\'' ? read_quoted(at) : read_plain(at);
}

std::size_t YamlFaultFinder::read_open(std::size_t at) {
  if (!brackets_.empty()) {
    OpenBracket& outer = brackets_.back();
    if (outer.is_complete && outer.is_plain) {
      const std::size_t end = end_of_entry(at);
      const std::string_view entry =
          without_blanks_at_end(text_.substr(outer.value_begin, end - outer.value_begin));
      report({at, at + 1},
             fmt::format("'{}' in a text without quotes; in {} a text with brackets or commas "
                         "needs quotes",
                         text_[at], outer.closes_by == ']' ? "[ ]" : "{ }"),
             {outer.value_begin, outer.value_begin + entry.size()}, fmt::format("\"{}\"", entry));
      return at;
    }
    if (outer.is_complete) {
      report_missing_comma(at);
      return at;
    }
    if (outer.value_begin == kNowhere) outer.value_begin = at;
  }
  brackets_.push_back({.offset = at, .closes_by = text_[at] == '{' ? '}' : ']'});
  return at + 1;
}

std::size_t YamlFaultFinder::read_close(std::size_t at) {
  const OpenBracket closed = brackets_.back();
  if (text_[at] != closed.closes_by) {
    report({at, at + 1},
           fmt::format("'{}' is here, but the '{}' before it is still open", text_[at],
                       text_[closed.offset]),
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

std::size_t YamlFaultFinder::read_quoted(std::size_t at) {
  OpenBracket& bracket = brackets_.back();
  if (bracket.is_complete) {
    report_missing_comma(at);
    return at;
  }
  if (bracket.value_begin == kNowhere) bracket.value_begin = at;
  bracket.is_complete = true;
  bracket.is_plain = false;
  const std::size_t close = find_closing_quote(text_.substr(0, end_), at);
  if (close == kNowhere) {
    open_quote_ = at;
    return end_;
  }
  bracket.value_end = close + 1;
  return close + 1;
}

std::size_t YamlFaultFinder::read_plain(std::size_t at) {
  OpenBracket& bracket = brackets_.back();
  if (bracket.is_complete && !bracket.is_plain) {
    report_missing_comma(at);
    return at;
  }
  if (bracket.value_begin == kNowhere) bracket.value_begin = at;
  bracket.is_complete = bracket.is_plain = true;
  std::size_t end = at;
  while (end < end_ && std::string_view(",[]{}").find(text_[end]) == kNowhere && !is_colon(end) &&
         !is_comment(end))
    ++end;
  bracket.value_end = at + without_blanks_at_end(text_.substr(at, end - at)).size();
  return std::max(end, at + 1);
}

std::size_t YamlFaultFinder::read_colon(std::size_t at) {
  OpenBracket& bracket = brackets_.back();
  if (!bracket.has_colon) {
    bracket.has_colon = true;
    bracket.is_complete = false;
    bracket.value_begin = kNowhere;
    return at + 1;
  }
  if (bracket.value_begin == kNowhere || bracket.value_begin < begin_) {
    report({at, at + 1}, "a second colon in one entry; a comma may be missing before it");
    return at;
  }
  const std::string_view value = text_.substr(bracket.value_begin, at - bracket.value_begin);
  const std::string_view word = last_word(value);
  const std::size_t before =
      without_blanks_at_end(value.substr(0, value.size() - word.size())).size();
  if (before > 0 && is_known_key(word)) {
    const std::size_t comma = bracket.value_begin + before;
    report({at - word.size(), at}, fmt::format("a comma is missing before '{}'", word),
           {comma, comma}, ",");
    return at;
  }
  const std::size_t end = end_of_entry(at);
  const std::string_view entry =
      without_blanks_at_end(text_.substr(bracket.value_begin, end - bracket.value_begin));
  report({at, at + 1}, "a second colon in one entry; a text with a colon needs quotes",
         {bracket.value_begin, bracket.value_begin + entry.size()}, fmt::format("\"{}\"", entry));
  return at;
}

/// Where the entry at `at` ends: at a comma or a bracket that closes what is open before it.
std::size_t YamlFaultFinder::end_of_entry(std::size_t at) const {
  int depth = 0;
  for (; at < end_; ++at) {
    const char c = text_[at];
    if (c == '[' || c == '{') ++depth;
    if ((c == ',' || c == ']' || c == '}') && depth == 0) return at;
    if (c == ']' || c == '}') --depth;
  }
  return end_;
}

void YamlFaultFinder::report_missing_comma(std::size_t at) {
  const std::size_t end = brackets_.back().value_end;
  const std::size_t line_begin = text_.rfind('\n', at) + 1;
  if (end == kNowhere || end < line_begin)
    report({at, at + 1}, "a comma is missing at the end of the line above this one");
  else
    report({at, at + 1}, "a comma is missing before this", {end, end}, ",");
}

void YamlFaultFinder::report_open_quote() {
  const std::size_t begin = text_.rfind('\n', open_quote_) + 1;
  std::size_t end = std::min(text_.find('\n', open_quote_), text_.size());
  if (end > begin && text_[end - 1] == '\r') --end;
  std::size_t close = end;
  if (!brackets_.empty()) close = std::min(text_.find_first_of(",]}", open_quote_), end);
  report({open_quote_, open_quote_ + 1}, "the quote that opens here is not closed on its line",
         {close, close}, std::string(1, text_[open_quote_]));
}

void YamlFaultFinder::report_open_bracket() {
  std::string closers;
  for (auto bracket = brackets_.rbegin(); bracket != brackets_.rend(); ++bracket)
    closers += bracket->closes_by;
  const std::size_t at = brackets_.back().offset;
  const std::size_t saved_begin = std::exchange(begin_, last_line_.first);
  const std::size_t saved_end = std::exchange(end_, last_line_.second);
  const std::size_t end = text_end(begin_);
  begin_ = saved_begin;
  end_ = saved_end;
  report({at, at + 1}, fmt::format("the '{}' that opens here is never closed", text_[at]),
         {end, end}, closers);
}

}  // namespace

std::optional<YamlFault> find_yaml_fault(std::string_view text, std::size_t stop) {
  return YamlFaultFinder(text, stop).run();
}

std::span<const std::string_view> known_yaml_keys() { return kKnownKeys; }

}  // namespace oriel::rules
