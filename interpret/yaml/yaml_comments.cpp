#include "interpret/yaml/yaml_comments.h"

#include <algorithm>

namespace oriel::rules {

namespace {

/// Where scalars stand that are quoted or blocks, in which a # is a letter.
class Scalars {
 public:
  Scalars(const YamlNode& root, std::string_view text) {
    collect(root);
    std::ranges::sort(begins_);
    for (const std::size_t begin : begins_) add(begin, text);
  }

  /// The end of the scalar that `offset` is in, or `offset`.
  [[nodiscard]] std::size_t skip(std::size_t offset) const {
    const auto after = std::ranges::upper_bound(spans_, offset, {}, &Span::begin);
    if (after == spans_.begin()) return offset;
    return std::max(offset, std::prev(after)->end);
  }

 private:
  void collect(const YamlNode& node) {
    if (node.kind == YamlNode::Kind::scalar && !node.is_plain) begins_.push_back(node.span.begin);
    for (const YamlNode& item : node.items) collect(item);
    for (const YamlEntry& entry : node.entries) {
      collect(entry.key);
      collect(entry.value);
    }
  }

  void add(std::size_t begin, std::string_view text) {
    const char quote = begin > 0 ? text[begin - 1] : ' ';
    if (quote == '"' || quote == '\'') {
      spans_.push_back({begin - 1, find_closing_quote(text, begin - 1) + 1});
      return;
    }
    // A block: all lines that are empty or go in deeper than the line it begins on.
    const std::size_t line = text.rfind('\n', begin) + 1;
    const std::size_t depth = text.find_first_not_of(' ', line) - line;
    std::size_t end = text.find('\n', begin);
    while (end < text.size()) {
      const std::size_t next = text.find_first_not_of(' ', end + 1);
      const bool is_deeper = next < text.size() && (text[next] == '\n' || next - end - 1 > depth);
      if (!is_deeper) break;
      end = std::min(text.find('\n', next), text.size());
    }
    spans_.push_back({begin, std::min(end, text.size())});
  }

  std::vector<std::size_t> begins_;
  std::vector<Span> spans_;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

}  // namespace

std::vector<YamlComment> find_comments(const YamlNode& root, std::string_view text) {
  const Scalars scalars(root, text);
  std::vector<YamlComment> comments;
  bool is_start = true;  // of a line, but for blanks
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t behind = scalars.skip(at);
    if (behind > at) {
      at = behind - 1;
      is_start = false;
    } else if (text[at] == '\n') {
      const bool is_again = !comments.empty() && comments.back().text.empty() &&
                            text.find_first_not_of(" \t\r\n", comments.back().offset) >= at;
      if (is_start && !is_again) comments.push_back({at, "", true});
      is_start = true;
    } else if (text[at] == '#' && (at == 0 || is_blank(text[at - 1]) || text[at - 1] == '\n')) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      std::string comment(text.substr(at, end - at));
      comment.erase(comment.find_last_not_of(" \t\r") + 1);
      comments.push_back({at, std::move(comment), is_start});
      at = end;  // its line end is no empty line
      is_start = true;
    } else if (!is_blank(text[at])) {
      is_start = false;
    }
  }
  return comments;
}

}  // namespace oriel::rules
