#include "interpret/editing/cursor/spot.h"

#include "interpret/editing/completion/open_ends.h"
#include "interpret/language/findings.h"
#include "interpret/language/source.h"
#include "interpret/yaml/yaml_scan.h"
#include "interpret/yaml/yaml_tree.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace oriel::rules {

namespace {

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
