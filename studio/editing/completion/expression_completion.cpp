#include "interpret/language/findings.h"
#include "interpret/language/lexer.h"
#include "interpret/language/parser.h"
#include "interpret/language/quantity.h"
#include "kernel/base/text/suggest.h"
#include "model/description/feature_table.h"
#include "studio/editing/completion/completion.h"
#include "studio/editing/cursor/word_texts.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace oriel::rules {

namespace {

bool is_word_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '@';
}

/// Completes an expression of which the begin is written.
class ExpressionCompleter {
 public:
  ExpressionCompleter(const PackLayers& layers, YamlPlace place, const std::string& written,
                      std::size_t offset, std::vector<Completion>& completions)
      : layers_(&layers), place_(place), completions_(&completions) {
    std::size_t word = written.size();
    while (word > 0 && is_word_part(written[word - 1])) --word;
    if (word > 0 && written[word - 1] == '$') {
      --word;
      is_param_ = true;
    }
    replaced_ = {offset - (written.size() - word), offset};
    is_number_ =
        !is_param_ && word < written.size() && written[word] >= '0' && written[word] <= '9';
    source_.emplace("", written.substr(0, word));
    tokens_ = tokens_of(*source_, {0, word});
    const std::size_t end = tokens_.empty() ? 0 : tokens_.back().span.end;
    is_readable_ = written.find_first_not_of(" \t", end) >= word;
  }

  void run() {
    if (!is_readable_ || is_number_) return;
    if (is_param_) return add_params();
    if (is_after_word("is")) return add_after_is();
    if (is_at_relation()) return add_relations();
    if (is_after(Token::Kind::dot)) return add_after_dot();
    if (add_fixed_argument()) return;
    if (is_after(Token::Kind::number)) return add_after_number();
    if (is_after_operand()) return add_operators();
    if (const std::string attribute = compared_attribute(tokens_); !attribute.empty())
      return add_words_of(attribute);
    add_operands();
  }

 private:
  [[nodiscard]] const Token* token_before(std::size_t count = 0) const {
    return count < tokens_.size() ? &tokens_[tokens_.size() - 1 - count] : nullptr;
  }
  [[nodiscard]] bool is_after(Token::Kind kind, std::size_t count = 0) const {
    const Token* token = token_before(count);
    return token != nullptr && token->kind == kind;
  }
  [[nodiscard]] bool is_after_word(std::string_view word, std::size_t count = 0) const {
    const Token* token = token_before(count);
    return token != nullptr && token->kind == Token::Kind::word && token->text == word;
  }
  [[nodiscard]] bool is_after_one_of(const std::vector<std::string>& words,
                                     std::size_t count) const {
    const Token* token = token_before(count);
    return token != nullptr && token->kind == Token::Kind::word && contains(words, token->text);
  }

  [[nodiscard]] bool is_at_relation() const {
    return is_after_word("of") ||
           (is_after(Token::Kind::open_round) && is_after_one_of(quantifier_names(), 1));
  }
  /// `distance_along(` and `gap(` take one fixed word; false where neither is open.
  bool add_fixed_argument() {
    if (!is_after(Token::Kind::open_round)) return false;
    const bool is_distance = is_after_word("distance_along", 1);
    if (!is_distance && !is_after_word("gap", 1)) return false;
    if (is_distance)
      add("other", "word", text_of_language("other"));
    else
      add("members", "word", {"", "", "of the group"});
    return true;
  }

  /// The last token ends a value or a condition, so that an operator comes next.
  [[nodiscard]] bool is_after_operand() const {
    const Token* last = token_before();
    if (last == nullptr) return false;
    switch (last->kind) {
      case Token::Kind::parameter:
      case Token::Kind::close_round:
      case Token::Kind::close_square:
      case Token::Kind::percent:
      case Token::Kind::map_unit:
        return true;
      case Token::Kind::word:
        return !contains(reserved_words(), last->text);
      default:
        return false;
    }
  }

  /// The word before the innermost bracket that is open, and how many tokens come after it.
  struct OpenCall {
    std::string_view function;
    std::size_t tokens = 0;
  };
  [[nodiscard]] std::optional<OpenCall> open_call() const {
    int closed = 0;
    for (std::size_t i = tokens_.size(); i-- > 0;) {
      if (tokens_[i].kind == Token::Kind::close_round) ++closed;
      if (tokens_[i].kind != Token::Kind::open_round) continue;
      if (closed-- > 0) continue;
      const bool has_word = i > 0 && tokens_[i - 1].kind == Token::Kind::word;
      return OpenCall{has_word ? tokens_[i - 1].text : std::string_view(), tokens_.size() - 1 - i};
    }
    return std::nullopt;
  }

  void add(std::string label, std::string kind, const WordText& text, std::string insert = "") {
    if (insert.empty()) insert = label;
    completions_->push_back({std::move(label), std::move(kind), text.detail, text.meaning,
                             std::move(insert), replaced_});
  }
  void add_language(const std::vector<std::string>& words) {
    for (const std::string& word : words) add(word, "word", text_of_language(word));
  }

  void add_params() {
    const std::size_t before = completions_->size();
    add_declared(*layers_, WordSort::param, replaced_, *completions_);
    for (std::size_t i = before; i < completions_->size(); ++i) {
      Completion& completion = (*completions_)[i];
      completion.label = completion.insert = "$" + completion.label;
    }
  }

  void add_relations() { add_declared(*layers_, WordSort::relation, replaced_, *completions_); }

  void add_after_is() {
    if (is_after_word("host", 1))
      for (const char* kind : {"wall", "roof", "ground"})
        add(kind, "value", {"", "of the host facet", "by its inclination and hosts:"});
    add_declared(*layers_, WordSort::class_name, replaced_, *completions_);
  }

  void add_after_dot() {
    add_attributes();
    add_declared(*layers_, WordSort::macro, replaced_, *completions_);
    add("host", "word", text_of_language("host"), "host is ");
  }

  /// A number has a unit, or stands alone; `1 .. ` is a range already.
  void add_after_number() {
    for (const std::string& unit : unit_names()) add(unit, "unit", text_of_unit(unit));
    if (is_of_map()) add("mm@map", "unit", text_of_unit("mm@map"));
    add_operators();
  }

  void add_operators() {
    const auto call = open_call();
    const bool is_quantifier = call && contains(quantifier_names(), call->function);
    const bool is_relation = (is_quantifier && call->tokens == 1) || is_after_word("of", 1);
    if (is_relation) return add_language({"where"});
    if (const Token* tilde = token_before(1); tilde != nullptr && tilde->kind == Token::Kind::tilde)
      return add_language({"by"});
    const bool is_aggregate = call && contains({"min", "max", "mean"}, call->function);
    if (is_aggregate) add_language({"of"});
    if (place_ == YamlPlace::constant || place_ == YamlPlace::map_constant) return;
    if (is_after_word("host") || is_after_word("self")) return add_language({"is"});
    add_language({"and", "or", "in"});
  }

  void add_words_of(std::string_view attribute) {
    for (const auto* schema : {&feature_schema(), &surface_schema()}) {
      const auto found = std::ranges::find(*schema, attribute, &AttributeInfo::name);
      if (found == schema->end()) continue;
      for (const std::string& word : found->words)
        add(word, "value", {"", "of " + std::string(attribute), found->meaning});
      return;
    }
  }

  /// After `width >= ` a param is more likely than another attribute.
  [[nodiscard]] bool is_after_comparison() const {
    return !tokens_.empty() && tokens_.back().kind >= Token::Kind::less &&
           tokens_.back().kind <= Token::Kind::not_equal;
  }

  void add_operands() {
    if (is_after_comparison()) add_params();
    if (is_after_word("host") || is_after_word("self") || is_after_word("other"))
      return add_language({"is"});
    if (place_ != YamlPlace::constant && place_ != YamlPlace::map_constant) {
      add_attributes();
      add_declared(*layers_, WordSort::macro, replaced_, *completions_);
    }
    if (is_of_map()) add("scale", "value", {"", "N of 1:N", "of the map that is made"});
    add_params();
    if (place_ == YamlPlace::constant || place_ == YamlPlace::map_constant) return;
    add_functions();
    add_language({"not"});
    if (!has_relations()) return;
    add("self is", "word", text_of_language("is"), "self is ");
    add("host is", "word", text_of_language("host"), "host is ");
    add("is", "word", text_of_language("is"), "is ");
    add("self", "word", text_of_language("self"), "self.");
    if (open_call() || place_ == YamlPlace::pair_condition)
      add("other", "word", text_of_language("other"), "other.");
  }

  void add_functions() {
    for (const std::string& function : function_names())
      add(function, "function", text_of_function(function), call_of(function));
    if (!has_relations()) return;
    if (place_ != YamlPlace::pair_condition)
      for (const std::string& quantifier : quantifier_names())
        add(quantifier, "function", text_of_function(quantifier), call_of(quantifier));
    if (open_call() || place_ == YamlPlace::pair_condition)
      add("distance_along", "function", text_of_function("distance_along"),
          "distance_along(other)");
    if (is_of_map()) add("gap", "function", text_of_function("gap"), "gap(members)");
  }

  void add_attributes() {
    const auto add_all = [&](const std::vector<AttributeInfo>& schema) {
      for (const AttributeInfo& attribute : schema)
        add(attribute.name, "attribute", text_of_attribute(attribute.name));
    };
    if (place_ != YamlPlace::surface_condition) add_all(feature_schema());
    if (place_ == YamlPlace::surface_condition || place_ == YamlPlace::macro_body)
      add_all(surface_schema());
  }

  [[nodiscard]] bool is_of_map() const {
    return place_ == YamlPlace::map_condition || place_ == YamlPlace::map_constant;
  }
  [[nodiscard]] bool has_relations() const { return place_ != YamlPlace::surface_condition; }

  const PackLayers* layers_;
  YamlPlace place_;
  std::vector<Completion>* completions_;
  std::optional<Source> source_;
  std::vector<Token> tokens_;
  TextSpan replaced_;
  bool is_param_ = false;
  bool is_number_ = false;
  bool is_readable_ = true;
};

}  // namespace

void complete_expression(const PackLayers& layers, YamlPlace place, const std::string& written,
                         std::size_t offset, std::vector<Completion>& completions) {
  ExpressionCompleter(layers, place, written, offset, completions).run();
}

}  // namespace oriel::rules
