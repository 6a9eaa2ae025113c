#include "studio/editing/completion/completion.h"

#include "interpret/pack/embedded.h"
#include "model/description/feature_table.h"
#include "studio/editing/completion/schema_keys.h"
#include "studio/editing/cursor/spot.h"
#include "studio/editing/cursor/word_texts.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace oriel::rules {

namespace {

/// Of what is written the end that a completion replaces.
TextSpan replaced_by(const WritingSpot& spot) {
  return {spot.begin, spot.begin + spot.written.size()};
}

void add_plain(std::string label, std::string kind, std::string detail, TextSpan replaced,
               std::vector<Completion>& completions) {
  std::string insert = label;
  completions.push_back(
      {std::move(label), std::move(kind), std::move(detail), "", std::move(insert), replaced});
}

void add_keys(const WritingSpot& spot, std::vector<SchemaWord> keys,
              std::vector<Completion>& completions) {
  std::ranges::stable_sort(keys, std::ranges::greater{}, &SchemaWord::is_required);
  for (SchemaWord& key : keys) {
    const bool is_there = std::ranges::find(spot.siblings, key.name) != spot.siblings.end();
    if (is_there) continue;
    std::string insert = key.name + ": ";
    completions.push_back({std::move(key.name), "key", key.is_required ? "required" : "",
                           std::move(key.meaning), std::move(insert), replaced_by(spot)});
  }
}

void add_attributes(TextSpan replaced, std::vector<Completion>& completions) {
  for (const AttributeInfo& attribute : feature_schema()) {
    WordText text = text_of_attribute(attribute.name);
    completions.push_back(
        {attribute.name, "attribute", text.detail, text.meaning, attribute.name + ": ", replaced});
  }
}

/// What is named by its name alone, as a key or a value; `after` comes after it.
void add_names_at(const PackLayers& layers, YamlPlace place, TextSpan replaced,
                  std::vector<Completion>& completions) {
  switch (place) {
    case YamlPlace::class_name:
      return add_declared(layers, WordSort::class_name, replaced, completions);
    case YamlPlace::label:
      add_declared(layers, WordSort::class_name, replaced, completions);
      return add_plain("unknown", "value", "no rule holds", replaced, completions);
    case YamlPlace::target:
      add_declared(layers, WordSort::class_name, replaced, completions);
      add_plain("any", "value", "every feature", replaced, completions);
      for (const DeclaredName& declared : layers.names())
        if (declared.sort == WordSort::group)
          add_plain("group " + declared.name, "group", text_of(declared).detail, replaced,
                    completions);
      return;
    case YamlPlace::relation:
      return add_declared(layers, WordSort::relation, replaced, completions);
    case YamlPlace::group_name:
      return add_declared(layers, WordSort::group, replaced, completions);
    case YamlPlace::rule_name:
      return add_declared(layers, WordSort::rule, replaced, completions);
    case YamlPlace::fixture_name:
      return add_declared(layers, WordSort::fixture, replaced, completions);
    case YamlPlace::attribute_name:
      return add_attributes(replaced, completions);
    case YamlPlace::pack_name:
      for (const EmbeddedPack& pack : embedded())
        add_plain(std::string(pack.name), "pack", "built in", replaced, completions);
      return;
    default:
      return;
  }
}

/// Names of packs beneath, which this one may declare anew with other values.
void add_names_beneath(const PackLayers& layers, WordSort sort, const WritingSpot& spot,
                       std::vector<Completion>& completions) {
  for (const DeclaredName& declared : layers.names()) {
    const bool is_there = std::ranges::find(spot.siblings, declared.name) != spot.siblings.end();
    if (declared.sort != sort || declared.layer == &layers.top() || is_there) continue;
    Completion completion = completion_of(declared, replaced_by(spot));
    completion.insert += ": ";
    completion.documentation += "\nstated in " + declared.layer->source.file();
    completions.push_back(std::move(completion));
  }
}

void complete_key(const PackLayers& layers, const WritingSpot& spot,
                  std::vector<Completion>& completions) {
  const YamlPlace place = place_of(spot.path, true);
  YamlPath map = spot.path;
  map.pop_back();
  if (is_expression(place))
    return complete_expression(layers, place, spot.written, spot.begin + spot.written.size(),
                               completions);
  if (place == YamlPlace::new_param)
    return add_names_beneath(layers, WordSort::param, spot, completions);
  if (place == YamlPlace::new_class)
    return add_names_beneath(layers, WordSort::class_name, spot, completions);
  if (place == YamlPlace::new_macro)
    return add_names_beneath(layers, WordSort::macro, spot, completions);
  if (place != YamlPlace::other) {
    const std::size_t before = completions.size();
    add_names_at(layers, place, replaced_by(spot), completions);
    for (std::size_t i = before; i < completions.size(); ++i)
      if (!completions[i].insert.ends_with(": ")) completions[i].insert += ": ";
    return;
  }
  add_keys(spot, schema_keys(layers.grammar(), map), completions);
}

void complete_value(const PackLayers& layers, const WritingSpot& spot,
                    std::vector<Completion>& completions) {
  const YamlPlace place = place_of(spot.path, false);
  add_names_at(layers, place, replaced_by(spot), completions);
  const bool is_operator =
      spot.path.size() == 3 && spot.path[0].key == "generalise" && spot.path[2].key == "do";
  for (const SchemaWord& value : schema_values(layers.grammar(), spot.path)) {
    const WordText text = is_operator ? text_of_operator(value.name) : WordText{"value"};
    completions.push_back({value.name, text.sort, text.detail,
                           text.meaning.empty() ? value.meaning : text.meaning, value.name,
                           replaced_by(spot)});
  }
  if (is_expression(place) && completions.empty())
    complete_expression(layers, place, spot.written, spot.begin + spot.written.size(), completions);
}

}  // namespace

Completion completion_of(const DeclaredName& declared, TextSpan replaced) {
  WordText text = text_of(declared);
  return {declared.name,           std::move(text.sort), std::move(text.detail),
          std::move(text.meaning), declared.name,        replaced};
}

void add_declared(const PackLayers& layers, WordSort sort, TextSpan replaced,
                  std::vector<Completion>& completions) {
  std::set<std::string_view> seen;
  for (const DeclaredName& declared : layers.names())
    if (declared.sort == sort && seen.insert(declared.name).second)
      completions.push_back(completion_of(declared, replaced));
  if (sort != WordSort::relation) return;
  for (const RelationKind& relation : relation_schema()) {
    if (!seen.insert(relation.name).second) continue;
    WordText text = text_of_relation(relation.name);
    completions.push_back({relation.name, "relation", std::move(text.detail),
                           std::move(text.meaning), relation.name, replaced});
  }
}

std::vector<Completion> completions_at(const PackLayers& layers, std::size_t offset) {
  std::vector<Completion> completions;
  for (const WritingSpot& spot : spots_at(layers.top().source.text(), offset))
    if (spot.is_key)
      complete_key(layers, spot, completions);
    else
      complete_value(layers, spot, completions);
  std::set<std::string> seen;
  std::erase_if(completions, [&](const Completion& completion) {
    return !seen.insert(completion.insert).second;
  });
  return completions;
}

}  // namespace oriel::rules
