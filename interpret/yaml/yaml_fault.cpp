#include "interpret/yaml/yaml_fault.h"

#include "interpret/yaml/known_keys.h"
#include "interpret/yaml/yaml_brackets.h"
#include "interpret/yaml/yaml_scan.h"
#include "interpret/yaml/yaml_tree.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// A map or list in block style that is open: its entries begin in one column.
struct BlockLevel {
  std::size_t column = 0;
  bool is_list = false;
  /// Its last entry has no value on its own line, so that one may follow below it.
  bool has_open_value = false;
  /// What its last entry begins with.
  std::string_view name;
};

/// Reads a text line by line, as YAML readers do, and stops at the first line that cannot be right.
class YamlFaultFinder {
 public:
  YamlFaultFinder(std::string_view text, std::size_t stop)
      : scan_(text), brackets_(scan_), stop_(stop) {}

  std::optional<YamlFault> run() {
    const std::size_t size = scan_.text.size();
    for (std::size_t at = 0; at < size && at <= stop_ && !scan_.fault; at = scan_.next_line()) {
      scan_.go_to_line(at);
      check_line();
      if (!scan_.is_blank_line() && !scan_.fault) last_text_end_ = scan_.text_end(scan_.begin);
    }
    if (!scan_.fault && scan_.open_quote != kNowhere) report_open_quote();
    if (!scan_.fault && brackets_.are_open() && stop_ >= size)
      brackets_.report_open(last_text_end_);
    return std::move(scan_.fault);
  }

 private:
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

  void read_brackets(std::size_t at);
  void report_open_quote();

  YamlScan scan_;
  YamlBrackets brackets_;
  std::size_t stop_;
  std::size_t last_text_end_ = 0;  ///< of the last line that is not blank
  std::vector<BlockLevel> levels_;
  std::size_t bracket_column_ = 0;         ///< indentation of the line on which brackets begin
  std::size_t bracket_value_ = 0;          ///< where the outermost begins
  std::size_t literal_column_ = kNowhere;  ///< what stands deeper is of a text after | or >
};

void YamlFaultFinder::check_line() {
  std::size_t at = scan_.skip_blanks(scan_.begin);
  if (scan_.open_quote != kNowhere) {
    std::string quoted(1, scan_.text[scan_.open_quote]);
    quoted += scan_.line();
    const std::size_t close = find_closing_quote(quoted, 0);
    if (close == kNowhere) return;
    at = scan_.skip_blanks(scan_.begin + close);
    if (!brackets_.are_open() && !scan_.is_at_end(at)) return report_open_quote();
    scan_.open_quote = kNowhere;
    if (brackets_.are_open()) read_brackets(at);
    return;
  }
  if (scan_.is_at_end(at)) return;
  const std::size_t column = at - scan_.begin;
  if (literal_column_ != kNowhere && column > literal_column_) return;
  literal_column_ = kNowhere;
  if (brackets_.are_open()) {
    const bool closes = scan_.text[at] == '}' || scan_.text[at] == ']';
    if (column <= bracket_column_ && !closes) return brackets_.report_open(last_text_end_);
    return read_brackets(at);
  }
  if (check_tab(at)) return;
  if (scan_.line().starts_with("---") || scan_.line().starts_with("...")) return;
  check_block(at);
}

bool YamlFaultFinder::check_tab(std::size_t content) {
  const std::size_t tab = scan_.line().find('\t');
  if (tab == kNowhere || scan_.begin + tab >= content) return false;
  scan_.report({scan_.begin + tab, scan_.begin + tab + 1},
               "there is a tab before this line; YAML is indented by spaces",
               {scan_.begin, content}, std::string(column_for_tabs(content), ' '));
  return true;
}

/// Where what stands after tabs was probably meant to begin.
std::size_t YamlFaultFinder::column_for_tabs(std::size_t content) const {
  std::size_t column = 0;
  for (std::size_t i = scan_.begin; i < content; ++i) column += scan_.text[i] == '\t' ? 2 : 1;
  const bool is_list = scan_.text[content] == '-';
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
  if (scan_.fault || scan_.is_at_end(at)) return;
  check_entry(at, at != content);
}

/// Reads the dashes of list items; returns where what stands after them begins.
std::size_t YamlFaultFinder::enter_items(std::size_t at) {
  while (at < scan_.end && scan_.text[at] == '-' &&
         (at + 1 == scan_.end || is_blank_character(scan_.text[at + 1]))) {
    if (!enter(at, true, "-")) return at;
    levels_.back().has_open_value = true;
    at = scan_.skip_blanks(at + 1);
  }
  const bool is_glued = at + 1 < scan_.end && scan_.text[at] == '-' && scan_.text[at + 1] != '-' &&
                        !(scan_.text[at + 1] >= '0' && scan_.text[at + 1] <= '9');
  if (is_glued)
    scan_.report({at, at + 1}, "a space is missing after '-', which begins a list item",
                 {at, at + 1}, "- ");
  return at;
}

void YamlFaultFinder::check_entry(std::size_t at, bool is_item) {
  const char c = scan_.text[at];
  std::size_t colon = kNowhere;
  if (c == '"' || c == '\'') {
    const std::size_t close = find_closing_quote(scan_.text.substr(0, scan_.end), at);
    const std::size_t after = close == kNowhere ? scan_.end : scan_.skip_blanks(close + 1);
    if (scan_.is_colon(after)) colon = after;
  } else if (c != '{' && c != '[') {
    colon = scan_.find_colon(at, scan_.text_end(at));
  }
  if (colon == kNowhere) return check_without_colon(at, is_item);
  const std::string_view key = scan_.text.substr(at, colon - at);
  if (!enter(at, false, key)) return;
  if (const std::size_t brace = key.find(" {"); brace != kNowhere && c != '"' && c != '\'')
    return scan_.report({at, at + brace},
                        fmt::format("a colon is missing after '{}'", key.substr(0, brace)),
                        {at + brace, at + brace}, ":");
  const std::size_t value = scan_.skip_blanks(colon + 1);
  levels_.back().has_open_value = scan_.is_at_end(value);
  if (!scan_.is_at_end(value)) check_value(value);
}

void YamlFaultFinder::check_value(std::size_t at) {
  const char c = scan_.text[at];
  if (c == '|' || c == '>') {
    literal_column_ = levels_.empty() ? 0 : levels_.back().column;
  } else if (c == '{' || c == '[') {
    bracket_column_ = scan_.skip_blanks(scan_.begin) - scan_.begin;
    bracket_value_ = at;
    read_brackets(at);
  } else if (c == '"' || c == '\'') {
    const std::size_t close = find_closing_quote(scan_.text.substr(0, scan_.end), at);
    if (close == kNowhere)
      scan_.open_quote = at;
    else
      check_after_value(at, close + 1);
  } else {
    check_plain_value(at);
  }
}

void YamlFaultFinder::check_plain_value(std::size_t at) {
  const std::size_t end = scan_.text_end(at);
  const std::string_view value = scan_.text.substr(at, end - at);
  const std::string quoted = fmt::format("\"{}\"", value);
  if (value.front() == '%' || value.front() == '@' || value.front() == '`') {
    const bool is_share = value.front() == '%' && value.size() > 1;
    return scan_.report(
        {at, at + 1},
        fmt::format("a text cannot begin with '{}' unless it is in quotes{}", value.front(),
                    is_share ? "; the unit % comes after its number" : ""),
        {at, end}, is_share ? fmt::format("{} %", value.substr(1)) : quoted);
  }
  const std::size_t colon = scan_.find_colon(at, end);
  if (colon == kNowhere) return;
  const std::string_view word = last_word(scan_.text.substr(at, colon - at));
  if (is_known_yaml_key(word) && word.size() < colon - at)
    return scan_.report(
        {colon - word.size(), colon},
        fmt::format("a second key, '{}', on one line; it goes on a line of its own", word));
  scan_.report({colon, colon + 1}, "a second colon on one line; a text with a colon needs quotes",
               {at, end}, value.find('"') == kNowhere ? quoted : fmt::format("'{}'", value));
}

/// What stands alone: an item of a list, a value below its key, the next line of a text, or a key
/// without its colon.
void YamlFaultFinder::check_without_colon(std::size_t at, bool is_item) {
  const std::size_t end = scan_.text_end(at);
  const std::string_view content = scan_.text.substr(at, end - at);
  const std::string_view word = first_word(content);
  const bool has_glued_colon = !word.empty() && word.size() + 1 < content.size() &&
                               content[word.size()] == ':' && is_known_yaml_key(word);
  if (has_glued_colon)
    return scan_.report({at + word.size(), at + word.size() + 1},
                        fmt::format("a space is missing after '{}:'", word),
                        {at + word.size() + 1, at + word.size() + 1}, " ");
  const auto report_missing_colon = [&] {
    const SourceSpan place{at + word.size(), at + word.size()};
    scan_.report({at, at + word.size()}, fmt::format("a colon is missing after '{}'", word), place,
                 ":");
  };
  if (is_item) {
    levels_.back().has_open_value = false;
    const std::size_t next = scan_.next_line();
    const std::size_t below = std::min(scan_.text.find_first_not_of(' ', next), scan_.text.size());
    const bool is_key = is_known_yaml_key(word) && content.size() > word.size() &&
                        content[word.size()] == ' ' && below - next == at - scan_.begin &&
                        scan_.text[std::min(below, scan_.text.size() - 1)] != '-';
    return is_key ? report_missing_colon() : check_value(at);
  }
  const std::size_t column = at - scan_.begin;
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
    return scan_.report(
        {at, end},
        fmt::format("'{}' is what '{}' asks for, and begins in the same column; indent it", content,
                    level.name),
        {at, at}, "  ");
  if (!word.empty()) report_missing_colon();
}

/// What stands after a text in quotes or after brackets must be the end.
void YamlFaultFinder::check_after_value(std::size_t value, std::size_t at) {
  const std::size_t after = scan_.skip_blanks(at);
  if (scan_.is_at_end(after) || scan_.text[after] == ':') return;
  const std::size_t end = scan_.text_end(value);
  std::string mended;
  for (const char c : scan_.text.substr(value, end - value))
    if (c != scan_.text[value]) mended += c;
  const bool is_quoted = scan_.text[value] == '"' || scan_.text[value] == '\'';
  if (!is_quoted && (scan_.text[after] == '}' || scan_.text[after] == ']'))
    return scan_.report({after, after + 1},
                        fmt::format("nothing is open that '{}' could close", scan_.text[after]),
                        {after, after + 1}, "");
  if (!is_quoted)
    return scan_.report({after, end}, "a list or map in brackets ends here, but the line goes on");
  if (mended.find(": ") != kNowhere || mended.find('#') != kNowhere)
    mended = scan_.text[value] + mended + scan_.text[value];
  scan_.report({after, end},
               "the quotes end here, but the line goes on; quotes go round all of it or none",
               {value, end}, mended);
}

/// An entry begins at `at`. False and a fault if none can begin in this column.
bool YamlFaultFinder::enter(std::size_t at, bool is_list, std::string_view name) {
  const std::size_t column = at - scan_.begin;
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
  const std::size_t column = at - scan_.begin;
  const auto distance = [&](const BlockLevel& level) {
    return level.column > column ? level.column - column : column - level.column;
  };
  const BlockLevel* nearest = nullptr;
  for (const BlockLevel& level : before)
    if (level.is_list == is_list && (nearest == nullptr || distance(level) <= distance(*nearest)))
      nearest = &level;
  const BlockLevel& last = before.back();
  if (is_list && !last.is_list && last.column <= column)
    return scan_.report(
        {at, at + 1},
        fmt::format("a list begins here, but '{}' has a value on its own line already; "
                    "put that value below it as the first item, '- ...'",
                    last.name));
  if (nearest == nullptr)
    return scan_.report(
        {at, at + name.size()},
        fmt::format("'{}' begins a map, but the lines above are items of a list; begin it "
                    "with '- '",
                    name));
  if (nearest->column == column)
    return scan_.report({at, at + name.size()},
                        fmt::format("'{}' cannot begin here: what is above it continues", name));
  const std::string what = is_list ? "this list item" : fmt::format("'{}'", name);
  const std::string above =
      is_list ? "the item above it" : fmt::format("'{}' above it", nearest->name);
  scan_.report({at, at + name.size()},
               fmt::format("{} is indented by {}, {} by {}", what, counted(column, "space"), above,
                           nearest->column),
               {scan_.begin, at}, std::string(nearest->column, ' '));
}

void YamlFaultFinder::report_open_quote() {
  const std::size_t begin = scan_.text.rfind('\n', scan_.open_quote) + 1;
  std::size_t end = std::min(scan_.text.find('\n', scan_.open_quote), scan_.text.size());
  if (end > begin && scan_.text[end - 1] == '\r') --end;
  std::size_t close = end;
  if (brackets_.are_open())
    close = std::min(scan_.text.find_first_of(",]}", scan_.open_quote), end);
  scan_.report({scan_.open_quote, scan_.open_quote + 1},
               "the quote that opens here is not closed on its line", {close, close},
               std::string(1, scan_.text[scan_.open_quote]));
}

void YamlFaultFinder::read_brackets(std::size_t at) {
  const std::size_t after = brackets_.read(at);
  if (after != kNowhere) check_after_value(bracket_value_, after);
}

}  // namespace

std::optional<YamlFault> find_yaml_fault(std::string_view text, std::size_t stop) {
  return YamlFaultFinder(text, stop).run();
}

}  // namespace oriel::rules
