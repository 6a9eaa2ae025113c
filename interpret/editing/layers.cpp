#include "interpret/editing/layers.h"

#include "interpret/editing/cursor/tolerant_tree.h"
#include "interpret/editing/cursor/yaml_path.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace oriel::rules {

namespace {

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

bool PackLayers::is_tests() const { return find_value(top().tree, "tests_for") != nullptr; }

}  // namespace oriel::rules
