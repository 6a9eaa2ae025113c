#include "interpret/editing/renaming.h"

#include "interpret/language/findings.h"
#include "interpret/pack/loader.h"
#include "interpret/pack/names.h"
#include "kernel/model/description/feature_table.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

bool is_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// "a param".
std::string sort_in_words(WordSort sort) {
  switch (sort) {
    case WordSort::param:
      return "param";
    case WordSort::class_name:
      return "class";
    case WordSort::macro:
      return "macro";
    case WordSort::relation:
      return "relation";
    case WordSort::group:
      return "group";
    case WordSort::fixture:
      return "fixture";
    default:
      return "rule";
  }
}

void add_dollar_places(const std::string& text, const std::string& name,
                       std::vector<TextSpan>& places) {
  const std::string wanted = "$" + name;
  for (std::size_t at = text.find(wanted); at != std::string::npos;
       at = text.find(wanted, at + 1)) {
    const std::size_t end = at + wanted.size();
    if (end == text.size() || !is_of_name(text[end])) places.push_back({at + 1, end});
  }
}

}  // namespace

WordSort declared_sort(const PackWord& word) {
  return word.sort == WordSort::value_name ? WordSort::macro : word.sort;
}

std::string refuse_renaming(const PackLayers& layers, const PackWord& word) {
  const WordSort sort = declared_sort(word);
  const bool is_own = std::ranges::any_of(layers.names(), [&](const DeclaredName& declared) {
    return declared.sort == sort && declared.name == word.name && declared.layer == &layers.top();
  });
  for (const DeclaredName& declared : layers.names())
    if (declared.sort == sort && declared.name == word.name && declared.layer != &layers.top())
      return fmt::format("'{}' is {} in {}: rename it there", word.name,
                         is_own ? "also stated" : "stated", declared.layer->source.file());
  return is_own ? "" : fmt::format("'{}' is not a name that this pack states", word.name);
}

std::string refuse_name(const PackLayers& layers, const PackWord& word, const std::string& name) {
  const WordSort sort = declared_sort(word);
  if (name == word.name) return "";
  if (layers.find(sort, name) != nullptr)
    return fmt::format("there is a {} '{}' already", sort_in_words(sort), name);
  if (sort == WordSort::rule || sort == WordSort::entry)
    return is_rule_id(name) ? "" : "an id is names joined by points, such as door.ground";
  if (sort == WordSort::macro && find_attribute(name))
    return fmt::format("there is an attribute '{}'", name);
  const Source source("", name);
  Findings findings(source);
  YamlNode node;
  node.kind = YamlNode::Kind::scalar;
  node.text = name;
  if (expect_name(node, "a " + sort_in_words(sort), findings)) return "";
  return findings.spanned().front().sentence;
}

std::vector<TextSpan> places_of(const PackLayers& layers, WordSort sort, const std::string& name) {
  const PackLayer& top = layers.top();
  std::vector<TextSpan> places;
  for (const PackWord& word : pack_words(top.tree, top.source))
    if (is_same_name(layers, word, sort, name)) places.push_back({word.span.begin, word.span.end});
  if (sort == WordSort::param) add_dollar_places(top.source.text(), name, places);
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

}  // namespace oriel::rules
