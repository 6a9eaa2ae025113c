#include "studio/editing/layers.h"

#include "interpret/language/findings.h"
#include "interpret/pack/pack_grammar.h"
#include "interpret/plan/profile_grammar.h"
#include "interpret/testing/test_grammar.h"
#include "studio/editing/cursor/yaml_path.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

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

/// The tree of a text that may be broken; spans count in `text`. A section that cannot be read is
/// read without the lines at which its faults are, and left out if there are many. Its findings are
/// those of parse_yaml and not told here.
YamlNode read_tolerantly(const std::string& text) {
  if (auto read = try_to_read(text, {0, text.size()}); read.tree) return std::move(*read.tree);
  YamlNode root;
  root.kind = YamlNode::Kind::map;
  if (text.size() > kMostBytes) return root;
  std::string left = text;
  for (const SourceSpan section : sections_of(text)) read_section(left, section, root);
  return root;
}

struct NamedSection {
  std::string_view key{};
  WordSort sort;
};

constexpr std::array kMaps = {
    NamedSection{"params", WordSort::param}, NamedSection{"classes", WordSort::class_name},
    NamedSection{"macros", WordSort::macro}, NamedSection{"relations", WordSort::relation},
    NamedSection{"groups", WordSort::group}, NamedSection{"fixtures", WordSort::fixture}};
constexpr std::array kLists = {NamedSection{"rules", WordSort::rule},
                               NamedSection{"surfaces", WordSort::entry},
                               NamedSection{"generalise", WordSort::entry}};

void add_names(const PackLayer& layer, std::vector<DeclaredName>& names) {
  for (const NamedSection& section : kMaps)
    if (const YamlNode* map = find_value(layer.tree, section.key))
      for (const YamlEntry& entry : map->entries)
        names.push_back({section.sort, entry.key.text, &layer, entry.key.span, &entry.value});
  for (const NamedSection& section : kLists)
    if (const YamlNode* list = find_value(layer.tree, section.key))
      for (const YamlNode& item : list->items)
        if (const YamlNode* id = find_value(item, "id");
            id != nullptr && find_value(item, "remove") == nullptr)
          names.push_back({section.sort, id->text, &layer, id->span, &item});
}

/// What is beneath: the name after `extends:` or `tests_for:`.
std::string name_beneath(const YamlNode& tree) {
  for (const char* key : {"extends", "tests_for"})
    if (const YamlNode* name = find_value(tree, key)) return name->text;
  return "";
}

}  // namespace

PackLayers::PackLayers(std::string text, std::string file, const PackFinder& find) {
  YamlNode tree = read_tolerantly(text);
  layers_.push_back({Source(std::move(file), std::move(text)), std::move(tree)});
  for (std::string name = name_beneath(layers_.back().tree);
       !name.empty() && layers_.size() <= kMostBeneath; name = name_beneath(layers_.back().tree)) {
    auto found = find(name);
    if (!found) break;
    const bool is_known = std::ranges::any_of(
        layers_, [&](const PackLayer& layer) { return layer.source.file() == found->file; });
    if (is_known) break;
    tree = read_tolerantly(found->text);
    layers_.push_back({Source(std::move(found->file), std::move(found->text)), std::move(tree)});
  }
  for (const PackLayer& layer : layers_) add_names(layer, names_);
}

const DeclaredName* PackLayers::find(WordSort sort, std::string_view name) const {
  const auto found = std::ranges::find_if(names_, [&](const DeclaredName& declared) {
    return declared.sort == sort && declared.name == name;
  });
  return found == names_.end() ? nullptr : &*found;
}

const Grammar& PackLayers::grammar() const {
  if (find_value(top().tree, "tests_for") != nullptr) return test_grammar();
  return find_value(top().tree, "profile") != nullptr ? profile_grammar() : pack_grammar();
}

}  // namespace oriel::rules
