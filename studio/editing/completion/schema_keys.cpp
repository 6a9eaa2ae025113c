#include "studio/editing/completion/schema_keys.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

namespace oriel::rules {

namespace {

using json = nlohmann::ordered_json;  // keys stay in their order

/// The node and all that it stands for by `$ref` and `anyOf`.
void add_alternatives(const json& schema, const json& node, std::vector<const json*>& all) {
  all.push_back(&node);
  if (const auto ref = node.find("$ref"); ref != node.end())
    add_alternatives(schema, schema.at(json::json_pointer(ref->get<std::string>().substr(1))), all);
  if (const auto any = node.find("anyOf"); any != node.end())
    for (const json& alternative : *any) add_alternatives(schema, alternative, all);
}

void add_child(const json& schema, const json& node, const YamlStep& step,
               std::vector<const json*>& children) {
  const auto add_member = [&](const char* name) {
    const auto member = node.find(name);
    if (member != node.end() && member->is_object()) add_alternatives(schema, *member, children);
  };
  if (!step.is_key()) return add_member("items");
  const auto properties = node.find("properties");
  const bool is_named = properties != node.end() && properties->contains(step.key);
  if (is_named)
    add_alternatives(schema, properties->at(step.key), children);
  else
    add_member("additionalProperties");
}

std::vector<const json*> nodes_at(const json& schema, const YamlPath& path) {
  std::vector<const json*> nodes;
  add_alternatives(schema, schema, nodes);
  for (const YamlStep& step : path) {
    std::vector<const json*> children;
    for (const json* node : nodes) add_child(schema, *node, step, children);
    nodes = std::move(children);
  }
  return nodes;
}

std::string meaning_of(const json& schema, const json& node) {
  std::vector<const json*> all;
  add_alternatives(schema, node, all);
  for (const json* alternative : all)
    if (const auto text = alternative->find("description"); text != alternative->end())
      return text->get<std::string>();
  return "";
}

void add_word(std::vector<SchemaWord>& words, SchemaWord word) {
  const auto found = std::ranges::find(words, word.name, &SchemaWord::name);
  if (found == words.end()) words.push_back(std::move(word));
}

bool is_listed(const json& node, const char* list, const std::string& name) {
  const auto found = node.find(list);
  return found != node.end() && std::ranges::find(*found, json(name)) != found->end();
}

}  // namespace

std::vector<SchemaWord> schema_keys(const Grammar& grammar, const YamlPath& path) {
  const json& schema = grammar.tree();
  std::vector<SchemaWord> keys;
  bool is_first = true;  // of several forms the first is the usual one
  for (const json* node : nodes_at(schema, path)) {
    const auto properties = node->find("properties");
    if (properties == node->end()) continue;
    for (const auto& [name, property] : properties->items())
      add_word(keys, {name, meaning_of(schema, property),
                      is_first && is_listed(*node, "required", name)});
    is_first = false;
  }
  return keys;
}

std::vector<SchemaWord> schema_values(const Grammar& grammar, const YamlPath& path) {
  std::vector<SchemaWord> values;
  const auto add = [&](const json& value) {
    add_word(values, {value.is_string() ? value.get<std::string>() : value.dump(), ""});
  };
  for (const json* node : nodes_at(grammar.tree(), path)) {
    if (const auto list = node->find("enum"); list != node->end())
      std::ranges::for_each(*list, add);
    if (const auto one = node->find("const"); one != node->end()) add(*one);
    if (const auto type = node->find("type"); type != node->end() && *type == "boolean") {
      add("true");
      add("false");
    }
  }
  return values;
}

std::string schema_meaning(const Grammar& grammar, const YamlPath& path) {
  for (const json* node : nodes_at(grammar.tree(), path))
    if (const auto text = node->find("description"); text != node->end())
      return text->get<std::string>();
  return "";
}

}  // namespace oriel::rules
