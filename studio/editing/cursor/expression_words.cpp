#include "studio/editing/cursor/expression_words.h"

#include "interpret/compile/name_lookup.h"
#include "interpret/language/findings.h"
#include "interpret/language/parser.h"
#include "kernel/base/text/suggest.h"
#include "model/description/feature_table.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace oriel::rules {

namespace {

bool is_word_token(const Token& token, std::string_view word) {
  return token.kind == Token::Kind::word && token.text == word;
}

bool is_quantifier_word(const Token& token) {
  return is_word_token(token, "exists") || is_word_token(token, "none") ||
         is_word_token(token, "count") || is_word_token(token, "all");
}

bool has_texts(std::string_view name) {
  for (const auto* schema : {&feature_schema(), &surface_schema()}) {
    const auto found = std::ranges::find(*schema, name, &AttributeInfo::name);
    if (found != schema->end()) return found->unit == Unit::text;
  }
  return false;
}

/// The sort of the word at `i`.
WordSort sort_of(const std::vector<Token>& tokens, std::size_t i) {
  const Token none;
  const Token& before = i > 0 ? tokens[i - 1] : none;
  const Token& before_that = i > 1 ? tokens[i - 2] : none;
  const Token& next = i + 1 < tokens.size() ? tokens[i + 1] : none;
  const std::string word(tokens[i].text);
  if (is_word_token(before, "is"))
    return is_word_token(before_that, "host") && contains(host_kinds(), word)
               ? WordSort::facet
               : WordSort::class_name;
  const bool opens_quantifier =
      before.kind == Token::Kind::open_round && is_quantifier_word(before_that);
  if (opens_quantifier || is_word_token(before, "of")) return WordSort::relation;
  if (before.kind == Token::Kind::number && !contains(reserved_words(), word))
    return WordSort::unit;
  if (next.kind == Token::Kind::open_round && !is_word_token(tokens[i], "in"))
    return contains({"and", "or", "not", "where", "by"}, word) ? WordSort::language
                                                               : WordSort::function;
  return contains(reserved_words(), word) ? WordSort::language : WordSort::value_name;
}

PackWord word_at(const std::vector<Token>& tokens, std::size_t i) {
  const Token& token = tokens[i];
  PackWord word{WordSort::unit, std::string(token.text), token.span};
  if (token.kind == Token::Kind::parameter) {
    word.sort = WordSort::param;
    ++word.span.begin;
  }
  if (token.kind != Token::Kind::word) return word;
  word.sort = sort_of(tokens, i);
  if (word.sort != WordSort::value_name) return word;
  word.attribute = compared_attribute({tokens.begin(), tokens.begin() + std::ptrdiff_t(i)});
  if (!word.attribute.empty()) word.sort = WordSort::text_value;
  return word;
}

/// A name that stands alone as a key or a value; nothing for places where there is no name.
struct PlaceSort {
  YamlPlace place;
  WordSort sort;
  bool is_declaration = false;
};
constexpr PlaceSort kPlaceSorts[] = {{YamlPlace::new_param, WordSort::param, true},
                                     {YamlPlace::new_class, WordSort::class_name, true},
                                     {YamlPlace::new_macro, WordSort::macro, true},
                                     {YamlPlace::new_relation, WordSort::relation, true},
                                     {YamlPlace::new_group, WordSort::group, true},
                                     {YamlPlace::new_rule, WordSort::rule, true},
                                     {YamlPlace::new_entry, WordSort::entry, true},
                                     {YamlPlace::class_name, WordSort::class_name},
                                     {YamlPlace::label, WordSort::class_name},
                                     {YamlPlace::target, WordSort::class_name},
                                     {YamlPlace::relation, WordSort::relation},
                                     {YamlPlace::group_name, WordSort::group},
                                     {YamlPlace::rule_name, WordSort::rule},
                                     {YamlPlace::pack_name, WordSort::pack},
                                     {YamlPlace::attribute_name, WordSort::attribute},
                                     {YamlPlace::fixture_name, WordSort::fixture}};

/// Takes the word before a name from it: `not door`, `group rows`.
bool drop_first_word(PackWord& word, std::string_view first) {
  if (!word.name.starts_with(first)) return false;
  word.name.erase(0, first.size());
  word.span.begin += first.size();
  return true;
}

/// The condition in `fails at "width > $least"`, an outcome of tests; empty if there is none.
SourceSpan condition_of_outcome(const YamlNode& node) {
  constexpr std::string_view kAt = " at ";
  const std::size_t at = node.text.find(kAt);
  if (at == std::string::npos) return {};
  const std::size_t begin = node.text.find_first_not_of(" \"'", at + kAt.size());
  const std::size_t last = node.text.find_last_not_of(" \"'");
  if (begin == std::string::npos || last < begin) return {};
  return {node.span.begin + begin, node.span.begin + last + 1};
}

void add_name(const YamlNode& node, YamlPlace place, std::vector<PackWord>& words) {
  const auto* known = std::ranges::find(kPlaceSorts, place, &PlaceSort::place);
  if (known == std::end(kPlaceSorts)) return;
  PackWord word{known->sort, node.text, node.span, known->is_declaration};
  if (place == YamlPlace::label) drop_first_word(word, "not ");
  if (place == YamlPlace::target && drop_first_word(word, "group ")) word.sort = WordSort::group;
  if (place == YamlPlace::relation) std::ranges::replace(word.name, ' ', '_');
  words.push_back(std::move(word));
}

}  // namespace

std::vector<Token> tokens_of(const Source& source, SourceSpan where) {
  Findings findings(source);
  auto tokens = tokenise(where, findings);
  if (!tokens) {
    Findings none(source);
    tokens = tokenise({where.begin, findings.spanned().front().where.begin}, none);
  }
  if (!tokens) return {};
  tokens->pop_back();
  return std::move(*tokens);
}

std::string compared_attribute(const std::vector<Token>& tokens) {
  std::size_t i = tokens.size();
  const auto kind_before = [&] { return i > 0 ? tokens[i - 1].kind : Token::Kind::end; };
  const bool is_in_list =
      kind_before() == Token::Kind::comma || kind_before() == Token::Kind::open_square;
  if (is_in_list) {
    while (kind_before() == Token::Kind::comma || kind_before() == Token::Kind::word) --i;
    if (kind_before() != Token::Kind::open_square) return "";
    --i;
    if (i == 0 || !is_word_token(tokens[i - 1], "in")) return "";
  } else if (kind_before() != Token::Kind::equal && kind_before() != Token::Kind::not_equal) {
    return "";
  }
  --i;
  if (kind_before() != Token::Kind::word || !has_texts(tokens[i - 1].text)) return "";
  return std::string(tokens[i - 1].text);
}

std::vector<PackWord> expression_words(const Source& source, SourceSpan where) {
  std::vector<PackWord> words;
  const auto tokens = tokens_of(source, where);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const Token::Kind kind = tokens[i].kind;
    const bool is_word = kind == Token::Kind::word || kind == Token::Kind::parameter ||
                         kind == Token::Kind::percent || kind == Token::Kind::map_unit;
    if (is_word) words.push_back(word_at(tokens, i));
  }
  return words;
}

std::vector<PackWord> pack_words(const YamlNode& root, const Source& source) {
  std::vector<PackWord> words;
  visit_yaml(root, [&](const YamlNode& node, const YamlPath& path, bool is_key) {
    if (node.kind != YamlNode::Kind::scalar || !node.is_verbatim) return;
    const YamlPlace place = place_of(path, is_key);
    if (!is_expression(place) && place != YamlPlace::outcome) return add_name(node, place, words);
    const SourceSpan span = is_expression(place) ? node.span : condition_of_outcome(node);
    for (PackWord& word : expression_words(source, span)) words.push_back(std::move(word));
  });
  std::ranges::stable_sort(words, {}, &PackWord::span);
  return words;
}

}  // namespace oriel::rules
