#include "interpret/pack/vocabulary.h"

#include "interpret/language/synonyms.h"
#include "interpret/plan/operators.h"
#include "kernel/base/text/suggest.h"
#include "model/description/attributes.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel {

namespace {

std::string unit_name(Unit unit) {
  switch (unit) {
    case Unit::text:
      return "text";
    case Unit::yes_no:
      return "yes/no";
    case Unit::count:
      return "count";
    case Unit::ratio:
      return "ratio";
    default:
      return std::string(suffix_of(unit));
  }
}

/// A condition that asks for the attribute, with a value of its unit.
std::string example_of(const AttributeInfo& attribute) {
  const std::string& name = attribute.name;
  if (name == info_of(Attribute::lod).name) return "lod < 3";  // a level is no share of anything
  switch (attribute.unit) {
    case Unit::text:
      return attribute.words.empty() ? fmt::format("{} = window", name)
                                     : fmt::format("{} = {}", name, attribute.words.front());
    case Unit::yes_no:
      return name;
    case Unit::count:
      return fmt::format("{} >= 2", name);
    case Unit::ratio:
      return fmt::format("{} > 0.5", name);
    case Unit::degree:
      return fmt::format("{} in 75 deg .. 105 deg", name);
    default:
      return fmt::format("{} in 0.5 {} .. 2 {}", name, suffix_of(attribute.unit),
                         suffix_of(attribute.unit));
  }
}

std::string example_of(const OperatorKind& kind) {
  if (kind.arguments.empty()) return kind.name;
  std::string arguments;
  for (const OperatorArgument& argument : kind.arguments) {
    std::string value = "50 %";
    if (argument.kind == "length") value = "0.5 mm@map";
    if (argument.kind == "word") value = argument.words.front();
    arguments += fmt::format("{}{}: {}", arguments.empty() ? "" : ", ", argument.name, value);
  }
  return fmt::format("{{{}: {{{}}}}}", kind.name, arguments);
}

std::string argument_in_words(const OperatorArgument& argument) {
  const std::string kind =
      argument.kind == "word" ? "one of " + join(argument.words) : "a " + argument.kind;
  return fmt::format("{}: {} ({})", argument.name, argument.meaning, kind);
}

std::vector<std::string> synonyms_of(rules::NameKind kind, std::string_view name) {
  std::vector<std::string> synonyms;
  for (const rules::NameSynonym& synonym : rules::name_synonyms())
    if (synonym.kind == kind && synonym.ours == name) synonyms.emplace_back(synonym.theirs);
  return synonyms;
}

std::vector<VocabularyWord> vocabulary_of(const std::vector<AttributeInfo>& schema,
                                          rules::NameKind kind) {
  std::vector<VocabularyWord> words;
  for (const AttributeInfo& attribute : schema)
    words.push_back({attribute.name, unit_name(attribute.unit), attribute.meaning,
                     example_of(attribute), attribute.words, synonyms_of(kind, attribute.name)});
  return words;
}

}  // namespace

std::vector<VocabularyWord> attribute_words() {
  return vocabulary_of(feature_schema(), rules::NameKind::attribute);
}

std::vector<VocabularyWord> surface_attribute_words() {
  return vocabulary_of(surface_schema(), rules::NameKind::surface_attribute);
}

std::vector<VocabularyWord> relation_words() {
  std::vector<VocabularyWord> words;
  for (const RelationKind& relation : relation_schema())
    words.push_back({relation.name,
                     "",
                     relation.meaning,
                     fmt::format("exists({} where sense = hole)", relation.name),
                     {},
                     synonyms_of(rules::NameKind::relation, relation.name)});
  return words;
}

std::vector<VocabularyWord> operator_words() {
  std::vector<VocabularyWord> words;
  for (const OperatorKind& kind : operator_table()) {
    VocabularyWord& word = words.emplace_back();
    word.name = kind.name;
    word.meaning = kind.meaning;
    word.example = example_of(kind);
    for (const OperatorArgument& argument : kind.arguments)
      word.values.push_back(argument_in_words(argument));
    word.synonyms = synonyms_of(rules::NameKind::operation, kind.name);
  }
  return words;
}

std::optional<VocabularyWord> find_word(const std::vector<VocabularyWord>& words,
                                        std::string_view name) {
  const std::string normal = rules::normal_name(name);
  const auto named = [&](const std::string& wanted) {
    return std::ranges::find(words, wanted, &VocabularyWord::name);
  };
  auto found = named(std::string(name));
  if (found == words.end()) found = named(normal);
  if (found == words.end())
    found = std::ranges::find_if(
        words, [&](const VocabularyWord& word) { return contains(word.synonyms, normal); });
  return found == words.end() ? std::nullopt : std::optional(*found);
}

}  // namespace oriel
