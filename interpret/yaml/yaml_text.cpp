#include "interpret/yaml/yaml_text.h"

#include "interpret/yaml/yaml_tree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// A comment of a YAML text, or an empty line, for which `text` is empty.
struct YamlComment {
  std::size_t offset = 0;
  /// With its #.
  std::string text;
  /// Nothing stands before it on its line.
  bool is_own_line = false;
};

/// The comments and empty lines of `text`, in their order; `root` is its tree. Of several empty
/// lines the first.
std::vector<YamlComment> find_comments(const YamlNode& root, std::string_view text);

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
    const auto after = std::ranges::upper_bound(spans_, offset, {}, &SourceSpan::begin);
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
  std::vector<SourceSpan> spans_;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::vector<YamlComment> find_comments(const YamlNode& root, std::string_view text) {
  const Scalars scalars(root, text);
  std::vector<YamlComment> comments;
  bool is_start = true;  // of a line, but for blanks
  for (std::size_t at = 0; at < text.size(); ++at) {
    const std::size_t end_of_scalar = scalars.skip(at);
    if (end_of_scalar > at) {
      at = end_of_scalar - 1;
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

/// Lines longer than this are hard to read beside a picture of a building.
constexpr std::size_t kMostColumns = 120;
constexpr std::size_t kIndent = 2;

std::string quoted(const std::string& text) {
  const bool has_control = std::ranges::any_of(
      text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
  if (!has_control && text.find_first_of("\"\\") == std::string::npos) return '"' + text + '"';
  if (!has_control && text.find('\'') == std::string::npos) return '\'' + text + '\'';
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out.append({'\\', c});
    else if (static_cast<unsigned char>(c) < 0x20)
      out += fmt::format("\\x{:02x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out + '"';
}

std::string scalar_text(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::null) return "~";
  return node.is_plain ? node.text : quoted(node.text);
}

/// The node in one line; nothing if a plain scalar in it would have to be quoted there.
bool append_inline(const YamlNode& node, std::string& out) {
  if (node.kind == YamlNode::Kind::scalar || node.kind == YamlNode::Kind::null) {
    out += scalar_text(node);
    return !node.is_plain || node.text.find_first_of(",[]{}") == std::string::npos;
  }
  const char* separator = "";
  out += node.kind == YamlNode::Kind::map ? '{' : '[';
  for (const YamlNode& item : node.items) {
    out += std::exchange(separator, ", ");
    if (!append_inline(item, out)) return false;
  }
  for (const YamlEntry& entry : node.entries) {
    out += std::exchange(separator, ", ");
    if (!append_inline(entry.key, out)) return false;
    out += ": ";
    if (!append_inline(entry.value, out)) return false;
  }
  out += node.kind == YamlNode::Kind::map ? '}' : ']';
  return true;
}

class Printer {
 public:
  /// `is_spaced`: an empty line parts sections; else those among the comments do.
  Printer(std::vector<YamlComment> comments, bool is_spaced)
      : comments_(std::move(comments)), is_spaced_(is_spaced) {}

  std::string print(const YamlNode& root) {
    static constexpr std::array<std::string_view, 3> kSmall = {"pack", "decide", "iterate"};
    for (const YamlEntry& entry : root.entries) {
      if (is_spaced_ && !out_.empty()) out_ += out_.ends_with('\n') ? "\n" : "\n\n";
      begin_line(entry.key.span.begin, 0);
      const bool is_small = std::ranges::find(kSmall, entry.key.text) != kSmall.end();
      is_in_rules_ = entry.key.text == "rules";
      print_entry(entry, 0, is_small);
    }
    end_line(std::string::npos);
    print_comments(std::string::npos, 0);
    while (out_.ends_with("\n\n")) out_.pop_back();
    return std::move(out_);
  }

 private:
  /// What follows begins at `offset` of the text that was read.
  void begin_line(std::size_t offset, std::size_t indent) {
    end_line(offset);
    print_comments(offset, indent);
    out_.append(indent, ' ');
  }

  /// Puts the comments that stood after the line at hand, or in what it says, at its end.
  void end_line(std::size_t offset) {
    if (out_.empty() || out_.back() == '\n') return;
    while (next_ < comments_.size() && comments_[next_].offset < offset &&
           !comments_[next_].is_own_line)
      out_ += "  " + comments_[next_++].text;
    out_ += '\n';
  }

  void print_comments(std::size_t offset, std::size_t indent) {
    for (; next_ < comments_.size() && comments_[next_].offset < offset; ++next_) {
      const std::string& text = comments_[next_].text;
      if (!text.empty()) out_ += std::string(indent, ' ') + text;
      if (!text.empty() || !(out_.empty() || out_.ends_with("\n\n"))) out_ += '\n';
    }
  }

  [[nodiscard]] std::size_t column() const {
    const std::size_t line = out_.rfind('\n');
    return line == std::string::npos ? out_.size() : out_.size() - line - 1;
  }

  /// Prints the node after what stands on the line, if there is room for all of it.
  bool print_inline(const YamlNode& node) {
    std::string text;
    if (!append_inline(node, text) || column() + text.size() > kMostColumns) return false;
    out_ += text;
    return true;
  }

  void print_entry(const YamlEntry& entry, std::size_t indent, bool is_inline) {
    const YamlNode& value = entry.value;
    out_ += scalar_text(entry.key) + ':';
    if (value.kind == YamlNode::Kind::null) return;
    out_ += ' ';
    if (value.kind == YamlNode::Kind::scalar) {
      out_ += scalar_text(value);
      return;
    }
    const bool is_empty = value.items.empty() && value.entries.empty();
    const bool has_maps = std::ranges::find(value.items, YamlNode::Kind::map, &YamlNode::kind) !=
                          value.items.end();  // terms of a score
    if (((is_inline && !has_maps) || is_empty) && print_inline(value)) return;
    out_.pop_back();
    print_block(value, indent + kIndent);
  }

  void print_block(const YamlNode& node, std::size_t indent) {
    for (const YamlEntry& entry : node.entries) {
      begin_line(entry.key.span.begin, indent);
      print_entry(entry, indent, true);
    }
    for (const YamlNode& item : node.items) {
      begin_line(begin_of(item), indent);
      out_ += "- ";
      print_item(item, indent + kIndent);
    }
  }

  /// A rule stands in a block, and so does what has one key only: a term of a score.
  void print_item(const YamlNode& item, std::size_t indent) {
    if (item.kind == YamlNode::Kind::scalar || item.kind == YamlNode::Kind::null) {
      out_ += scalar_text(item);
      return;
    }
    const bool is_rule = is_in_rules_ && indent == 2 * kIndent;
    const bool is_block = item.kind == YamlNode::Kind::map && (is_rule || item.entries.size() == 1);
    if (!is_block && print_inline(item)) return;
    for (std::size_t i = 0; i < item.entries.size(); ++i) {
      if (i > 0) begin_line(item.entries[i].key.span.begin, indent);
      print_entry(item.entries[i], indent, true);
    }
    if (!item.items.empty()) {
      out_.pop_back();
      print_block(item, indent);
    }
    if (item.items.empty() && item.entries.empty())
      out_ += item.kind == YamlNode::Kind::map ? "{}" : "[]";
  }

  static std::size_t begin_of(const YamlNode& item) {
    return item.entries.empty() ? item.span.begin : item.entries[0].key.span.begin;
  }

  std::vector<YamlComment> comments_;
  bool is_spaced_;
  std::size_t next_ = 0;
  bool is_in_rules_ = false;
  std::string out_;
};

}  // namespace

std::string to_yaml(const YamlNode& root) { return Printer({}, true).print(root); }

std::string to_yaml(const YamlNode& root, std::string_view text) {
  return Printer(find_comments(root, text), false).print(root);
}

bool is_same(const YamlNode& p, const YamlNode& q) {
  const auto is_item_same = [](const YamlNode& a, const YamlNode& b) { return is_same(a, b); };
  const auto is_entry_same = [](const YamlEntry& a, const YamlEntry& b) {
    return is_same(a.key, b.key) && is_same(a.value, b.value);
  };
  return p.kind == q.kind && p.text == q.text && p.is_plain == q.is_plain &&
         std::ranges::equal(p.items, q.items, is_item_same) &&
         std::ranges::equal(p.entries, q.entries, is_entry_same);
}

}  // namespace oriel::rules
