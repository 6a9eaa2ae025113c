#include "studio/editing/cursor/spot.h"

#include "interpret/language/findings.h"
#include "interpret/language/source.h"
#include "interpret/yaml/yaml_scan.h"
#include "interpret/yaml/yaml_tree.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace oriel::rules {

namespace {

/// What is open at the end of the begin of a YAML text.
struct OpenEnds {
  /// The brackets that would close what is open, innermost first, such as `]}`.
  std::string closers{};
  char quote = '\0';  ///< the text that is being written is in quotes of this kind
  bool is_comment = false;
  bool is_literal = false;  ///< it is among the lines of a text after `|` or `>`
  /// What is being written stands after its key; else it is a key, or an item of a list.
  bool is_value = false;
};

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

/// Reads `text`, which begins with a line that is not indented. Of a text that is no YAML the
/// answer is a guess.
OpenEnds open_ends_of(std::string_view text) { return OpenEndFinder(text).run(); }

/// A letter that stands for what comes next, so that there is something.
constexpr char kNext = 'x';

std::size_t begin_of_line(std::string_view text, std::size_t at) {
  const std::size_t end = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
  return end == std::string_view::npos ? 0 : end + 1;
}

std::size_t column_of_content(std::string_view line) {
  return std::min(line.find_first_not_of(' '), line.size());
}

bool is_item(std::string_view line) {
  const std::size_t at = column_of_content(line);
  return at < line.size() && line[at] == '-' &&
         (at + 1 == line.size() || is_blank_character(line[at + 1]));
}

bool says_nothing(std::string_view line) {
  const std::size_t at = line.find_first_not_of(" \t\r");
  return at == std::string_view::npos || line[at] == '#';
}

/// The begin of the section that `offset` is in.
std::size_t begin_of_section(std::string_view text, std::size_t offset) {
  std::size_t line = begin_of_line(text, offset);
  while (line > 0 &&
         (line >= text.size() || std::string_view(" \t\r\n#-}]").find(text[line]) != text.npos))
    line = begin_of_line(text, line - 1);
  return line;
}

/// What stands above a place, from the begin of its section on.
struct LinesAbove {
  /// The lines that the one at the place is below, one in each level, and that line up to it.
  std::string levels;
  /// The first of them, then all from the second on: the entry of the section that the place is in.
  std::string entry;
};

LinesAbove lines_above(std::string_view text, std::size_t from, std::size_t offset) {
  std::size_t line = begin_of_line(text, offset);
  const std::string_view last = text.substr(line, offset - line);
  LinesAbove above{std::string(last), {}};
  std::size_t entry = line;
  std::size_t column = column_of_content(last);
  bool is_of_list = is_item(last);
  while (line > from && (column > 0 || is_of_list)) {
    const std::size_t end = line - 1;
    line = begin_of_line(text, end);
    const std::string_view one = text.substr(line, end - line);
    if (says_nothing(one)) continue;
    const std::size_t at = column_of_content(one);
    const bool is_above = at < column || (at == column && is_of_list && !is_item(one));
    if (!is_above) continue;
    above.levels = std::string(one) + "\n" + above.levels;
    above.entry = std::string(one) + "\n" + std::string(text.substr(entry, offset - entry));
    entry = line;
    column = at;
    is_of_list = is_item(one);
  }
  if (above.entry.empty()) above.entry = text.substr(from, offset - from);
  return above;
}

/// The key or value of a tree that an offset is in, and the map whose key it is.
struct FoundNode {
  YamlPath path{};
  bool is_key = false;
  SourceSpan span{};
};

std::optional<FoundNode> find_node(const YamlNode& root, std::size_t offset) {
  std::optional<FoundNode> found;
  visit_yaml(root, [&](const YamlNode& node, const YamlPath& path, bool is_key) {
    const bool is_here = node.kind == YamlNode::Kind::scalar && node.is_verbatim &&
                         node.span.begin <= offset && offset <= node.span.end;
    if (is_here && !found) found = FoundNode{path, is_key, node.span};
  });
  return found;
}

std::vector<std::string> siblings_of(const YamlNode& root, const YamlPath& path) {
  const YamlNode* map = &root;
  for (std::size_t i = 0; i + 1 < path.size() && map != nullptr; ++i)
    map = path[i].is_key() ? find_value(*map, path[i].key)
                           : &map->items[static_cast<std::size_t>(path[i].index)];
  std::vector<std::string> keys;
  if (map == nullptr) return keys;
  for (const YamlEntry& entry : map->entries)
    if (entry.key.text != path.back().key) keys.push_back(entry.key.text);
  return keys;
}

/// Adds the key in the line if it begins in that column. False for a line that ends the map.
bool add_sibling(std::string_view line, std::size_t column, std::vector<std::string>& keys) {
  if (says_nothing(line)) return true;
  const std::size_t content = std::min(line.find_first_not_of(" -"), line.size());
  if (column_of_content(line) < column && content != column) return false;
  const std::string_view key = first_word(line.substr(content));
  if (content == column && !key.empty()) keys.emplace_back(key);
  // `- id: a` is the first line of its map.
  return column_of_content(line) >= column;
}

/// The keys in the lines around that begin in the column of the one that is written.
void add_siblings_around(std::string_view text, std::size_t offset, WritingSpot& spot) {
  std::size_t line = begin_of_line(text, spot.begin);
  const std::size_t column = spot.begin - line;
  const std::string_view before = text.substr(line, column);
  if (before.find_first_not_of(" -") != std::string_view::npos) return;
  bool goes_on = before.find('-') == std::string_view::npos;
  while (goes_on && line > 0) {
    const std::size_t end = line - 1;
    line = begin_of_line(text, end);
    goes_on = add_sibling(text.substr(line, end - line), column, spot.siblings);
  }
  std::size_t at = text.find('\n', offset);
  while (at != std::string_view::npos && at + 1 < text.size()) {
    const std::size_t begin = at + 1;
    at = text.find('\n', begin);
    const std::string_view below = text.substr(begin, at - begin);
    const bool is_next_item = is_item(below) && column_of_content(below) < column;
    if (is_next_item || !add_sibling(below, column, spot.siblings)) return;
  }
}

/// The spot at the end of `begin`, which is a part of `text` that ends at `offset`, if it is meant
/// as a key or a value.
std::optional<WritingSpot> spot_after(const std::string& begin, const OpenEnds& ends, bool as_key,
                                      std::string_view text, std::size_t offset) {
  std::string probe = begin + kNext;
  if (ends.quote != '\0') probe += ends.quote;
  if (as_key) probe += ": x";
  probe += ends.closers;
  const Source source("", std::move(probe));
  Findings findings(source);
  const auto tree = parse_yaml({0, source.text().size()}, findings);
  const auto node = tree ? find_node(*tree, begin.size()) : std::nullopt;
  if (!node || node->is_key != as_key) return std::nullopt;
  WritingSpot spot{node->path, as_key};
  spot.written = begin.substr(node->span.begin);
  spot.begin = offset - spot.written.size();
  if (!as_key) return spot;
  spot.siblings = siblings_of(*tree, spot.path);
  spot.path.back().key = spot.written;
  add_siblings_around(text, offset, spot);
  return spot;
}

}  // namespace

std::vector<WritingSpot> spots_at(std::string_view text, std::size_t offset) {
  offset = std::min(offset, text.size());
  const std::size_t from = begin_of_section(text, offset);
  const LinesAbove above = lines_above(text, from, offset);
  std::vector<WritingSpot> spots;
  for (const std::string* begin : {&above.entry, &above.levels}) {
    const OpenEnds ends = open_ends_of(*begin);
    if (ends.is_comment || ends.is_literal) break;
    for (const bool as_key : {true, false}) {
      if (as_key && ends.is_value) continue;
      if (auto spot = spot_after(*begin, ends, as_key, text, offset))
        spots.push_back(std::move(*spot));
    }
    if (!spots.empty()) break;
  }
  return spots;
}

}  // namespace oriel::rules
