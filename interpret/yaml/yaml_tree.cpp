#include "interpret/yaml/yaml_tree.h"

#include "interpret/yaml/yaml_fault.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <istream>
#include <set>
#include <streambuf>
#include <string_view>
#include <utility>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

namespace oriel::rules {

namespace {

bool report_fault(SourceSpan where, std::size_t stop, Findings& findings);

/// Ends the parse; what was wrong is among the findings.
struct Stop : std::exception {};

/// Reads from a text without copying it.
class TextBuffer : public std::streambuf {
 public:
  explicit TextBuffer(std::string_view text) {
    char* begin = const_cast<char*>(text.data());
    setg(begin, begin, begin + text.size());
  }
};

/// Builds YamlNodes from yaml-cpp's events. Events carry where a node begins and nothing of its
/// end; a scalar's end is found by comparing it with the text.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(SourceSpan where, Findings& findings) : findings_(&findings), where_(where) {}

  [[nodiscard]] YamlNode take_root() { return std::move(root_); }
  [[nodiscard]] bool has_root() const { return has_root_; }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (has_root_)
      stop(Code::R203, mark, "a pack is one YAML document; take out what follows '---'");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    refuse_anchor(mark, anchor);
    add(make_node(YamlNode::Kind::null, mark));
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    stop(Code::R203, mark, "a pack has no aliases (*name); write the value out, or use a macro");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    add(make_scalar(mark, tag, value));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    open(make_node(YamlNode::Kind::sequence, mark));
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    refuse_anchor(mark, anchor);
    refuse_tag(mark, tag);
    open(make_node(YamlNode::Kind::map, mark));
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    YamlNode node;
    std::set<std::string> keys;
    std::optional<YamlNode> key;
  };

  [[noreturn]] void stop(Code code, const YAML::Mark& mark, std::string sentence) {
    findings_->error(code, at(mark), std::move(sentence));
    throw Stop();
  }
  void refuse_anchor(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0)
      stop(Code::R203, mark, "a pack has no anchors (&name); write the value out, or use a macro");
  }
  void refuse_tag(const YAML::Mark& mark, const std::string& tag) {
    // yaml-cpp reports a plain node as "?" and a quoted scalar as "!".
    if (tag != "?" && tag != "!" && !tag.empty())
      stop(Code::R203, mark, "a pack has no tags (!name)");
  }

  [[nodiscard]] SourceSpan at(const YAML::Mark& mark) const {
    const auto offset = where_.begin + static_cast<std::size_t>(std::max(mark.pos, 0));
    const std::size_t begin = std::min(offset, where_.end);
    return {begin, begin};
  }

  YamlNode make_node(YamlNode::Kind kind, const YAML::Mark& mark) {
    if (++nodes_ > kMostYamlNodes)
      stop(Code::R213, mark, "a pack has no more than 100000 YAML nodes");
    YamlNode node;
    node.kind = kind;
    node.span = at(mark);
    return node;
  }

  YamlNode make_scalar(const YAML::Mark& mark, const std::string& tag, const std::string& value);
  void open(YamlNode node);
  void close();
  void add(YamlNode node);
  void add_key(Open& map, YamlNode key);

  Findings* findings_;
  SourceSpan where_;
  std::vector<Open> open_;
  YamlNode root_;
  bool has_root_ = false;
  std::size_t nodes_ = 0;
};

YamlNode TreeBuilder::make_scalar(const YAML::Mark& mark, const std::string& tag,
                                  const std::string& value) {
  const std::string_view text = std::string_view(findings_->source().text()).substr(0, where_.end);
  YamlNode node = make_node(YamlNode::Kind::scalar, mark);
  node.text = value;
  node.is_plain = tag == "?";
  std::size_t& begin = node.span.begin;
  const bool is_quoted = begin < text.size() && (text[begin] == '"' || text[begin] == '\'');
  if (!node.is_plain && is_quoted) {
    if (find_closing_quote(text, begin) == std::string_view::npos) {
      if (!report_fault(where_, where_.end, *findings_))
        stop(Code::R201, mark, "the quote that opens here is never closed");
      throw Stop();
    }
    ++begin;
  }
  node.is_verbatim =
      text.substr(begin, value.size()) == value && value.find('\n') == std::string::npos;
  node.span.end = begin + (node.is_verbatim ? value.size() : 0);
  return node;
}

void TreeBuilder::open(YamlNode node) {
  if (open_.size() >= kMostYamlDepth) {
    findings_->error(Code::R213, node.span, "a pack nests no deeper than 64 levels");
    throw Stop();
  }
  open_.push_back({std::move(node), {}, {}});
}

void TreeBuilder::close() {
  YamlNode node = std::move(open_.back().node);
  open_.pop_back();
  add(std::move(node));
}

void TreeBuilder::add(YamlNode node) {
  if (open_.empty()) {
    root_ = std::move(node);
    has_root_ = true;
    return;
  }
  Open& parent = open_.back();
  if (parent.node.kind == YamlNode::Kind::sequence) {
    parent.node.items.push_back(std::move(node));
  } else if (!parent.key) {
    add_key(parent, std::move(node));
  } else {
    node.of_key = parent.key->text;
    for (YamlNode& item : node.items) item.of_key = node.of_key;
    if (node.kind == YamlNode::Kind::null) node.span = {parent.key->span.end, parent.key->span.end};
    parent.node.entries.push_back({std::move(*parent.key), std::move(node)});
    parent.key.reset();
  }
}

void TreeBuilder::add_key(Open& map, YamlNode key) {
  // `sill {value: 1 m}` is a key `sill {value` to YAML.
  const bool has_brace = key.is_plain && key.text.find(" {") != std::string::npos;
  if (has_brace && report_fault(where_, key.span.begin, *findings_)) throw Stop();
  if (key.kind != YamlNode::Kind::scalar) {
    findings_->error(Code::R211, key.span, "a key is a text");
  } else if (!map.keys.insert(key.text).second) {
    findings_->error(Code::R202, key.span, "the key '" + key.text + "' occurs here twice");
  }
  map.key = std::move(key);
}

/// R201 where it is known what is wrong up to `stop`; else nothing is reported.
bool report_fault(SourceSpan where, std::size_t stop, Findings& findings) {
  const auto fault = find_yaml_fault(findings.source().text_of(where), stop - where.begin);
  if (!fault) return false;
  const SourceSpan span{where.begin + fault->where.begin, where.begin + fault->where.end};
  findings.error(Code::R201, span, fault->sentence);
  return true;
}

void report(SourceSpan where, Findings& findings, const YAML::Exception& problem) {
  const std::string& text = findings.source().text();
  const auto mark = static_cast<std::size_t>(std::max(problem.mark.pos, 0));
  const std::size_t offset = std::min(where.begin + mark, where.end);
  if (offset < where.end && text[offset] == '*')
    findings.error(Code::R203, {offset, offset}, "a pack has no aliases (*name)");
  else if (!report_fault(where, offset, findings))
    findings.error(Code::R201, {offset, offset},
                   "not YAML: " + problem.msg + "; the fault is here or on the lines before");
}

template <typename Node>
Node* value_in(Node& map, std::string_view key) {
  for (auto& entry : map.entries)
    if (entry.key.text == key) return &entry.value;
  return nullptr;
}

}  // namespace

YamlNode* find_value(YamlNode& map, std::string_view key) { return value_in(map, key); }

const YamlNode* find_value(const YamlNode& map, std::string_view key) { return value_in(map, key); }

std::size_t find_closing_quote(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  for (std::size_t i = begin + 1; i < text.size(); ++i) {
    const bool is_escape = quote == '"' ? text[i] == '\\' : text.substr(i, 2) == "''";
    if (is_escape)
      ++i;
    else if (text[i] == quote)
      return i;
  }
  return std::string_view::npos;
}

std::optional<YamlNode> parse_yaml(SourceSpan where, Findings& findings) {
  if (where.end - where.begin > kMostBytes) {
    findings.error(Code::R213, {where.begin, where.begin}, "a pack is no longer than 1 MiB");
    return std::nullopt;
  }
  TextBuffer buffer(findings.source().text_of(where));
  std::istream stream(&buffer);
  TreeBuilder builder(where, findings);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const Stop&) {
    return std::nullopt;
  } catch (const YAML::Exception& problem) {
    report(where, findings, problem);
    return std::nullopt;
  }
  if (!builder.has_root()) {
    findings.error(Code::R201, {where.begin, where.begin}, "the file is empty");
    return std::nullopt;
  }
  return builder.take_root();
}

std::optional<std::string> read_file(const std::string& path) {
  std::error_code problem;
  if (std::filesystem::is_directory(path, problem)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::string text(kMostBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) return std::nullopt;
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

}  // namespace oriel::rules
