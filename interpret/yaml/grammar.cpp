#include "interpret/yaml/grammar.h"

#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

namespace oriel::rules {

namespace {

using KeysOfMaps = std::map<std::string, std::vector<std::string>, std::less<>>;

/// Adds the maps of `node`, which is called `name`, and of all that is in it.
void add_maps(const nlohmann::ordered_json& node, const std::string& name, KeysOfMaps& all) {
  if (node.is_array())
    for (const auto& one : node) add_maps(one, name, all);
  if (!node.is_object()) return;
  for (const auto& [keyword, value] : node.items()) {
    const bool has_names = keyword == "properties" || keyword == "definitions";
    if (!has_names && keyword != "defaultSnippets") add_maps(value, name, all);
    if (!has_names) continue;
    if (keyword == "properties") {
      auto [entry, is_new] = all.try_emplace(name);
      if (is_new)
        for (const auto& property : value.items()) entry->second.push_back(property.key());
    }
    for (const auto& [inner, its] : value.items()) add_maps(its, inner, all);
  }
}

}  // namespace

Grammar::Grammar(std::string schema)
    : schema_(std::move(schema)),
      tree_(std::make_shared<nlohmann::ordered_json>(nlohmann::ordered_json::parse(schema_))) {
  add_maps(*tree_, "", keys_);
  for (const auto& [map, keys] : keys_) all_keys_.insert(keys.begin(), keys.end());
}

const std::vector<std::string>& Grammar::keys(std::string_view map) const {
  const auto found = keys_.find(map);
  if (found == keys_.end()) throw std::out_of_range("no map is called " + std::string(map));
  return found->second;
}

}  // namespace oriel::rules
