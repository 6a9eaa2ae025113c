#include "studio/editing/cursor/word_at.h"

#include "studio/editing/completion/schema_keys.h"
#include "studio/editing/cursor/spot.h"
#include "studio/editing/cursor/word_texts.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

bool is_name_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool is_around(SourceSpan span, std::size_t offset) {
  return span.begin <= offset && offset <= span.end;
}

/// Of two words that meet at `offset` the one that begins there.
std::optional<PackWord> find_around(const std::vector<PackWord>& words, std::size_t offset) {
  std::optional<PackWord> found;
  for (const PackWord& word : words) {
    // The $ before a param belongs to it.
    const bool has_dollar = word.sort == WordSort::param && !word.is_declaration;
    const std::size_t begin = word.span.begin - (has_dollar ? 1 : 0);
    if (is_around({begin, word.span.end}, offset)) found = word;
  }
  return found;
}

/// The words of the expression that ends with the word at `offset`, read for itself.
std::vector<PackWord> words_before(const PackLayers& layers, std::size_t offset) {
  const std::string& text = layers.top().source.text();
  std::size_t end = offset;
  while (end < text.size() && is_name_part(text[end])) ++end;
  for (const WritingSpot& spot : spots_at(text, end)) {
    if (!is_expression(place_of(spot.path, spot.is_key))) continue;
    const Source source("", spot.written);
    auto words = expression_words(source, {0, spot.written.size()});
    for (PackWord& word : words) {
      word.span.begin += spot.begin;
      word.span.end += spot.begin;
    }
    return words;
  }
  return {};
}

WordText text_of_built_in(const PackWord& word) {
  switch (word.sort) {
    case WordSort::value_name:
    case WordSort::attribute:
      return text_of_attribute(word.name);
    case WordSort::relation:
      return text_of_relation(word.name);
    case WordSort::text_value:
      return {"value of " + word.attribute, "", text_of_attribute(word.attribute).meaning};
    case WordSort::facet:
      return {"kind of the host facet", "", "by its inclination and 'hosts:'"};
    case WordSort::unit:
      return text_of_unit(word.name);
    case WordSort::function:
      return text_of_function(word.name);
    case WordSort::language:
      return text_of_language(word.name);
    default:
      return {};
  }
}

}  // namespace

std::optional<PackWord> word_at(const PackLayers& layers, std::size_t offset) {
  const PackLayer& top = layers.top();
  if (auto word = find_around(pack_words(top.tree, top.source), offset)) return word;
  return find_around(words_before(layers, offset), offset);
}

const DeclaredName* declaration_of(const PackLayers& layers, const PackWord& word) {
  if (word.sort == WordSort::value_name) return layers.find(WordSort::macro, word.name);
  return layers.find(word.sort, word.name);
}

bool is_same_name(const PackLayers& layers, const PackWord& word, WordSort sort,
                  std::string_view name) {
  if (word.name != name) return false;
  if (word.sort == WordSort::value_name)
    return sort == WordSort::macro && layers.find(WordSort::macro, name) != nullptr;
  return word.sort == sort;
}

std::string hover_text(const PackLayers& layers, const PackWord& word) {
  const DeclaredName* declared = declaration_of(layers, word);
  if (declared == nullptr) {
    const WordText text = text_of_built_in(word);
    return text.sort.empty() ? "" : text.hover(word.name);
  }
  std::string text = text_of(*declared).hover(word.name);
  if (declared->layer == &layers.top()) return text;
  const Place place = declared->layer->source.place(declared->span.begin);
  return text + fmt::format("\nstated in {}:{}", place.file, place.line);
}

std::optional<KeyText> key_text(const PackLayers& layers, std::size_t offset) {
  std::optional<KeyText> found;
  visit_yaml(layers.top().tree, [&](const YamlNode& node, const YamlPath& path, bool is_key) {
    const bool is_here = node.kind == YamlNode::Kind::scalar && is_around(node.span, offset) &&
                         node.span.begin < node.span.end;
    if (!is_here || found) return;
    const bool is_operator =
        path.size() == (is_key ? 4U : 3U) && path[0].key == "generalise" && path[2].key == "do";
    if (is_operator) {
      const WordText text = text_of_operator(node.text);
      if (!text.sort.empty()) found = KeyText{node.span, text.hover(node.text)};
    } else if (is_key && place_of(path, true) == YamlPlace::other) {
      const std::string meaning = schema_meaning(layers.grammar(), path);
      if (!meaning.empty()) found = KeyText{node.span, node.text + ": " + meaning};
    }
  });
  return found;
}

}  // namespace oriel::rules
