#include "studio/editing/cursor/word_texts.h"

#include "interpret/language/quantity.h"
#include "interpret/pack/vocabulary.h"
#include "studio/editing/cursor/yaml_path.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

std::string text_at(const YamlNode& map, std::string_view key) {
  const YamlNode* value = find_value(map, key);
  return value == nullptr ? "" : value->text;
}

WordText text_of_param(const YamlNode& value) {
  WordText text{"param", text_at(value, "value"), text_at(value, "why")};
  if (const std::string range = text_at(value, "range"); !range.empty())
    text.detail += " in " + range;
  return text;
}

WordText text_of_class(const YamlNode& value) {
  WordText text{"class"};
  if (text_at(value, "abstract") == "true") {
    text.sort = "predicate";
    text.meaning = "A feature may have several predicates; no label comes of them.";
  }
  if (const std::string above = text_at(value, "is"); !above.empty()) text.detail = "is " + above;
  const YamlNode* typical = find_value(value, "typical");
  if (typical == nullptr) return text;
  text.meaning = "typical:";
  for (const YamlEntry& entry : typical->entries)
    text.meaning += fmt::format(" {} {}", entry.value.text, entry.key.text);
  return text;
}

/// The conditions of a rule, one a line.
std::string conditions_at(const YamlNode& rule, std::string_view key) {
  const YamlNode* conditions = find_value(rule, key);
  if (conditions == nullptr) return "";
  std::string text = fmt::format("{}: {}", key, conditions->text);
  for (const YamlNode& item : conditions->items) text += "\n  " + item.text;
  return text + "\n";
}

WordText text_of_rule(const YamlNode& rule) {
  WordText text{"rule", text_at(rule, "label")};
  if (!text.detail.empty()) text.detail = "for " + text.detail;
  text.meaning = conditions_at(rule, "require") + conditions_at(rule, "unless");
  return text;
}

WordText text_of_word(std::string_view sort, const std::optional<VocabularyWord>& word) {
  if (!word) return {};
  WordText text{std::string(sort), word->unit, word->meaning};
  const bool is_operator = sort == "operator";
  for (const std::string& value : word->values)
    text.meaning += (&value != word->values.data() && !is_operator ? ", "
                     : is_operator                                 ? "\n"
                                                                   : "\nvalues: ") +
                    value;
  if (!word->example.empty()) text.meaning += "\nexample: " + word->example;
  return text;
}

struct FixedWord {
  std::string_view name{};
  std::string_view detail{};
  std::string_view meaning{};
};

constexpr FixedWord kFunctions[] = {
    {"exists", "exists(relation where condition)",
     "a related feature for which the condition holds exists"},
    {"none", "none(relation where condition)", "the condition holds for no related feature"},
    {"all", "all(relation where condition)", "the condition holds for all related features"},
    {"count", "count(relation where condition)",
     "the number of related features for which the condition holds"},
    {"abs", "abs(x)", "the number without its sign"},
    {"sqrt", "sqrt(x)", "the square root"},
    {"min", "min(x, y) or min(x of relation)",
     "the least of numbers, or of the related features' values"},
    {"max", "max(x, y) or max(x of relation)",
     "the greatest of numbers, or of the related features' values"},
    {"mean", "mean(x of relation)", "the mean of the related features' values"},
    {"distance_along", "distance_along(other)",
     "the distance between the middles of the lower edges of the two in their facade"},
    {"gap", "gap(members)", "the least distance between two members of the group on one facade"}};

constexpr FixedWord kLanguage[] = {
    {"and", "a and b", "both hold"},
    {"or", "a or b", "at least one holds"},
    {"not", "not a", "it does not hold"},
    {"in", "x in lo .. hi, or x in [a, b]",
     "the value lies in the range, ends included, or is one of the list"},
    {"is", "self is class, host is wall", "asks for a class, or for the kind of the host facet"},
    {"by", "x ~ y by 10 %", "the largest difference of what is similar"},
    {"where", "exists(relation where condition)", "the condition on the related feature"},
    {"of", "max(x of relation)", "the relation that leads to the values"},
    {"self", "self.attribute",
     "the feature that is to be labelled; in a quantifier the one that it starts from"},
    {"other", "other.attribute", "the related feature"},
    {"host", "host is wall", "the facet, or the feature, that this one was cut into or stands on"}};

template <std::size_t size>
WordText text_of_fixed(std::string_view sort, const FixedWord (&words)[size],
                       std::string_view name) {
  const auto* found = std::ranges::find(words, name, &FixedWord::name);
  if (found == std::end(words)) return {};
  return {std::string(sort), std::string(found->detail), std::string(found->meaning)};
}

}  // namespace

std::string WordText::hover(std::string_view name) const {
  std::string text = fmt::format("{}: {}", name, sort);
  if (!detail.empty()) text += ", " + detail;
  if (!meaning.empty()) text += "\n" + meaning;
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

WordText text_of(const DeclaredName& declared) {
  const YamlNode& value = *declared.value;
  switch (declared.sort) {
    case WordSort::param:
      return text_of_param(value);
    case WordSort::class_name:
      return text_of_class(value);
    case WordSort::macro:
      return {"macro", "", value.text};
    case WordSort::relation:
      return {"relation", "within " + text_at(value, "within"), text_at(value, "where")};
    case WordSort::group:
      return {"group", fmt::format("of {} by {}", text_at(value, "of"), text_at(value, "by"))};
    case WordSort::rule:
      return text_of_rule(value);
    case WordSort::fixture:
      return {"fixture"};
    default:
      return {"entry"};
  }
}

WordText text_of_attribute(std::string_view name) {
  const auto word = find_word(attribute_words(), name);
  if (word && word->name == name) return text_of_word("attribute", word);
  const auto of_surfaces = find_word(surface_attribute_words(), name);
  if (!of_surfaces || of_surfaces->name != name) return {};
  return text_of_word("attribute of surfaces", of_surfaces);
}

WordText text_of_relation(std::string_view name) {
  return text_of_word("relation", find_word(relation_words(), name));
}

WordText text_of_operator(std::string_view name) {
  return text_of_word("operator", find_word(operator_words(), name));
}

WordText text_of_function(std::string_view name) {
  return text_of_fixed("function", kFunctions, name);
}

WordText text_of_language(std::string_view name) {
  return text_of_fixed("word of the language", kLanguage, name);
}

WordText text_of_unit(std::string_view name) {
  if (name == "mm@map") return {"unit", "", "a millimetre on the map, so many as the scale says"};
  const auto unit = unit_word(name);
  if (!unit) return {};
  return {"unit", "", "of " + describe(unit->dimension)};
}

const std::vector<std::string>& function_names() {
  static const std::vector<std::string> names = {"abs", "min", "max", "mean", "sqrt"};
  return names;
}

const std::vector<std::string>& quantifier_names() {
  static const std::vector<std::string> names = {"exists", "none", "count", "all"};
  return names;
}

std::string call_of(std::string_view function) { return fmt::format("{}(", function); }

}  // namespace oriel::rules
