#include "interpret/editing/cursor/tolerant_tree.h"

#include "interpret/language/findings.h"
#include "interpret/language/source.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel::rules {

namespace {

/// So many lines are taken out of a section before it is given up.
constexpr int kMostLinesOut = 12;

struct YamlTry {
  std::optional<YamlNode> tree{};
  std::size_t fault = 0;
};

YamlTry try_to_read(const std::string& text, SourceSpan where) {
  const Source source("", text);
  Findings findings(source);
  YamlTry result{parse_yaml(where, findings)};
  const auto found = findings.spanned();
  if (!result.tree) result.fault = found.empty() ? where.begin : found.front().where.begin;
  return result;
}

bool begins_section(std::string_view text, std::size_t line) {
  return line < text.size() && std::string_view(" \t\r\n#-}]").find(text[line]) == text.npos;
}

/// From each line that is not indented to the next one.
std::vector<SourceSpan> sections_of(std::string_view text) {
  std::vector<SourceSpan> sections;
  for (std::size_t line = 0; line < text.size();) {
    if (begins_section(text, line)) {
      if (!sections.empty()) sections.back().end = line;
      sections.push_back({line, text.size()});
    }
    const std::size_t end = text.find('\n', line);
    line = end == std::string_view::npos ? text.size() : end + 1;
  }
  return sections;
}

/// Puts blanks in place of the line at `at`, as far as it is in `section`.
void blank_line(std::string& text, std::size_t at, SourceSpan section) {
  at = std::clamp(at, section.begin, section.end > section.begin ? section.end - 1 : section.begin);
  std::size_t begin = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  begin = begin == std::string::npos ? 0 : begin + 1;
  for (std::size_t i = std::max(begin, section.begin); i < section.end && text[i] != '\n'; ++i)
    text[i] = ' ';
}

void read_section(std::string& text, SourceSpan section, YamlNode& root) {
  for (int lines = 0; lines < kMostLinesOut; ++lines) {
    YamlTry read = try_to_read(text, section);
    if (read.tree) {
      std::ranges::move(read.tree->entries, std::back_inserter(root.entries));
      return;
    }
    blank_line(text, read.fault, section);
  }
}

}  // namespace

YamlNode read_tolerantly(const std::string& text) {
  if (auto read = try_to_read(text, {0, text.size()}); read.tree) return std::move(*read.tree);
  YamlNode root;
  root.kind = YamlNode::Kind::map;
  if (text.size() > kMostBytes) return root;
  std::string left = text;
  for (const SourceSpan section : sections_of(text)) read_section(left, section, root);
  return root;
}

}  // namespace oriel::rules
