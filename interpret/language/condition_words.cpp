#include "interpret/language/condition_words.h"

#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

using SyntaxKind = Syntax::Kind;

/// What the others of a relation are called; the first word gets an s where there are several.
struct RelationWords {
  std::string_view name;
  std::string_view others;
};
constexpr RelationWords kRelationWords[] = {
    {"host", "feature hosting it"},           {"contains", "feature in it"},
    {"inside", "feature around it"},          {"same_facade", "feature on its facade"},
    {"same_storey", "opening in its storey"}, {"alike", "feature like it"},
    {"beside", "feature beside it"},          {"above", "feature above it"},
};

std::string others_of(std::string_view relation) {
  for (const RelationWords& words : kRelationWords)
    if (words.name == relation) return std::string(words.others);
  return fmt::format("feature related by `{}`", relation);
}

std::string plural(const std::string& others) {
  const std::size_t end = others.find(' ');
  return others.substr(0, end) + "s" + (end == std::string::npos ? "" : others.substr(end));
}

bool is_of_several(const Syntax& syntax) {
  return syntax.kind == SyntaxKind::all_of || syntax.kind == SyntaxKind::any_of;
}

bool is_sum(const Syntax& syntax) {
  return syntax.kind == SyntaxKind::binary &&
         (syntax.symbol == Token::Kind::plus || syntax.symbol == Token::Kind::minus ||
          syntax.symbol == Token::Kind::star || syntax.symbol == Token::Kind::slash);
}

/// What stands between the two sides of a comparison.
std::string_view comparison(Token::Kind symbol) {
  switch (symbol) {
    case Token::Kind::less:
      return "is less than";
    case Token::Kind::less_equal:
      return "is at most";
    case Token::Kind::greater:
      return "is more than";
    case Token::Kind::greater_equal:
      return "is at least";
    case Token::Kind::equal:
      return "is";
    default:
      return "is not";
  }
}

bool is_product(const Syntax& syntax) {
  return is_sum(syntax) &&
         (syntax.symbol == Token::Kind::star || syntax.symbol == Token::Kind::slash);
}

/// True if the child of an arithmetic operator would be misread without brackets.
bool needs_brackets(const Syntax& outer, const Syntax& child, bool is_right) {
  if (!is_sum(child)) return false;
  if (is_product(outer) && !is_product(child)) return true;
  const bool undoes = outer.symbol == Token::Kind::minus || outer.symbol == Token::Kind::slash;
  return is_right && undoes && is_product(child) == is_product(outer);
}

std::string_view arithmetic(Token::Kind symbol) {
  if (symbol == Token::Kind::plus) return "+";
  if (symbol == Token::Kind::minus) return "-";
  return symbol == Token::Kind::star ? "×" : "/";
}

/// The comparison of a difference: `abs(x - y) <= t`.
bool is_difference(const Syntax& syntax) {
  const Syntax& left = syntax.children[0];
  return left.kind == SyntaxKind::call && left.name == "abs" &&
         left.children[0].kind == SyntaxKind::binary &&
         left.children[0].symbol == Token::Kind::minus && syntax.symbol != Token::Kind::equal &&
         syntax.symbol != Token::Kind::not_equal;
}

}  // namespace

std::string with_article(std::string_view name, std::string_view mark) {
  constexpr std::string_view kVowels = "aeiou";
  const bool has_vowel = !name.empty() && kVowels.find(name[0]) != std::string_view::npos;
  return fmt::format("{} {}{}{}", has_vowel ? "an" : "a", mark, name, mark);
}

std::string ConditionWords::macro(const Syntax& syntax) const {
  return say(syntax, Speaker::inside);
}

std::string ConditionWords::condition(const Syntax& syntax) const {
  return say(syntax, Speaker::top);
}

std::string ConditionWords::pair_condition(const Syntax& syntax) const {
  return say(syntax, Speaker::pair);
}

std::string ConditionWords::value(const Syntax& syntax) const {
  return operand(syntax, Speaker::top);
}

std::string ConditionWords::say(const Syntax& syntax, Speaker speaker) const {
  switch (syntax.kind) {
    case SyntaxKind::name:
      return name(syntax, speaker) + " holds";
    case SyntaxKind::is_test:
      return is_test(syntax, false, speaker);
    case SyntaxKind::negation:
      return negation(syntax, speaker);
    case SyntaxKind::quantifier:
      return syntax.name == "count" ? operand(syntax, speaker) : quantifier(syntax, false, speaker);
    case SyntaxKind::binary:
      return binary(syntax, speaker);
    case SyntaxKind::all_of:
      return joined(syntax, speaker, "and");
    case SyntaxKind::any_of:
      return joined(syntax, speaker, "or");
    case SyntaxKind::range_test:
      return fmt::format("{} is between {} and {}", operand(syntax.children[0], speaker),
                         operand(syntax.children[1], speaker),
                         operand(syntax.children[2], speaker));
    case SyntaxKind::list_test: {
      std::string words;
      for (std::size_t i = 1; i < syntax.children.size(); ++i) {
        if (i > 1) words += i + 1 == syntax.children.size() ? " or " : ", ";
        words += source_->text_of(syntax.children[i].span);
      }
      return fmt::format("{} is {}", operand(syntax.children[0], speaker), words);
    }
    case SyntaxKind::similarity:
      return fmt::format("{} and {} differ by at most {}", operand(syntax.children[0], speaker),
                         operand(syntax.children[1], speaker),
                         operand(syntax.children[2], speaker));
    default:
      return operand(syntax, speaker);
  }
}

/// The same as a part of `outer`, in brackets where it would be misread.
std::string ConditionWords::say_in(const Syntax& outer, const Syntax& syntax,
                                   Speaker speaker) const {
  const bool has_where = syntax.kind == SyntaxKind::quantifier && !syntax.children.empty();
  const bool is_other = is_of_several(syntax) && syntax.kind != outer.kind;
  const std::string text = say(syntax, speaker);
  return has_where || is_other ? "(" + text + ")" : text;
}

std::string ConditionWords::joined(const Syntax& syntax, Speaker speaker, const char* word) const {
  std::string text;
  for (const Syntax& child : syntax.children) {
    if (!text.empty()) text += fmt::format(", {} ", word);
    text += say_in(syntax, child, speaker);
  }
  return text;
}

std::string ConditionWords::name(const Syntax& syntax, Speaker speaker) const {
  if (syntax.scope == Syntax::Scope::other && speaker == Speaker::pair)
    return fmt::format("the other's `{}`", syntax.name);
  if (syntax.scope == Syntax::Scope::self && speaker == Speaker::inside)
    return fmt::format("the feature's own `{}`", syntax.name);
  return fmt::format("`{}`", syntax.name);
}

std::string ConditionWords::number(const Syntax& syntax) const {
  const std::string text(source_->text_of(syntax.span));
  const std::size_t unit = text.find("mm@map");
  return unit == std::string::npos ? text : text.substr(0, unit) + "mm on the map";
}

std::string ConditionWords::parameter(const Syntax& syntax) const {
  const auto found = values_.find(syntax.name);
  return found == values_.end() ? fmt::format("`${}`", syntax.name)
                                : fmt::format("`${}` ({})", syntax.name, found->second);
}

std::string ConditionWords::is_test(const Syntax& syntax, bool is_negated, Speaker speaker) const {
  const std::string_view is = is_negated ? "is not" : "is";
  std::string_view who = "it";
  if (syntax.scope == Syntax::Scope::self && speaker == Speaker::inside) who = "the feature itself";
  if (syntax.scope == Syntax::Scope::other && speaker == Speaker::pair) who = "the other";
  if (!syntax.is_of_host) return fmt::format("{} {} {}", who, is, with_article(syntax.name));
  if (syntax.name == "wall" || syntax.name == "roof" || syntax.name == "ground")
    return fmt::format("{} {} in {} {}", who, is_negated ? "does not lie" : "lies",
                       syntax.name == "ground" ? "the" : "a", syntax.name);
  if (who == "it") return fmt::format("its host {} {}", is, with_article(syntax.name));
  return fmt::format("the host of {} {} {}", who, is, with_article(syntax.name));
}

std::string ConditionWords::negation(const Syntax& syntax, Speaker speaker) const {
  const Syntax& inner = syntax.children[0];
  if (inner.kind == SyntaxKind::is_test) return is_test(inner, true, speaker);
  if (inner.kind == SyntaxKind::name) return name(inner, speaker) + " does not hold";
  if (inner.kind == SyntaxKind::quantifier && inner.name != "all")
    return quantifier(inner, true, speaker);
  return fmt::format("it is not so that {}", say_in(syntax, inner, speaker));
}

std::string ConditionWords::quantifier(const Syntax& syntax, bool is_negated,
                                       Speaker /*speaker*/) const {
  const bool is_none = (syntax.name == "none") != is_negated;
  if (syntax.name == "all")
    return fmt::format("all {}", others(syntax, true, 0)) +
           (syntax.children.empty() ? " hold" : "");
  const std::string other = others(syntax, false, 0);
  const bool has_vowel = other.front() == 'o';
  return fmt::format("there is {} {}", is_none ? "no" : has_vowel ? "an" : "a", other);
}

/// "feature beside it for which …"; the condition is child number `where`, if there is one.
std::string ConditionWords::others(const Syntax& syntax, bool is_plural, std::size_t where) const {
  std::string text = others_of(syntax.relation);
  if (is_plural) text = plural(text);
  if (syntax.children.size() <= where) return text;
  const bool is_all = syntax.kind == SyntaxKind::quantifier && syntax.name == "all";
  std::string condition = say(syntax.children[where], Speaker::inside);
  if (is_plural && !is_all && is_of_several(syntax.children[where]))
    condition = "(" + condition + ")";
  return fmt::format("{} {} {}", text, is_all ? "are such that" : "for which", condition);
}

std::string ConditionWords::binary(const Syntax& syntax, Speaker speaker) const {
  if (is_sum(syntax)) return operand(syntax, speaker);
  const std::string right = operand(syntax.children[1], speaker);
  const bool is_word =
      syntax.children[1].kind == SyntaxKind::name &&
      syntax.children[1].scope == Syntax::Scope::here &&
      (syntax.symbol == Token::Kind::equal || syntax.symbol == Token::Kind::not_equal);
  if (!is_difference(syntax))
    return fmt::format("{} {} {}", operand(syntax.children[0], speaker), comparison(syntax.symbol),
                       is_word ? syntax.children[1].name : right);
  const Syntax& difference = syntax.children[0].children[0];
  const std::string_view how = comparison(syntax.symbol).substr(std::string_view("is ").size());
  return fmt::format("{} and {} differ by {} {}", operand(difference.children[0], speaker),
                     operand(difference.children[1], speaker), how, right);
}

/// A value: a number, a name, what is calculated of them.
std::string ConditionWords::operand(const Syntax& syntax, Speaker speaker) const {
  switch (syntax.kind) {
    case SyntaxKind::number:
      return number(syntax);
    case SyntaxKind::parameter:
      return parameter(syntax);
    case SyntaxKind::name:
      return name(syntax, speaker);
    case SyntaxKind::negate:
      return "-" + operand(syntax.children[0], speaker);
    case SyntaxKind::call:
      return call(syntax, speaker);
    case SyntaxKind::quantifier:
      if (syntax.name == "count") return "the number of " + others(syntax, true, 0);
      return quantifier(syntax, false, speaker);
    case SyntaxKind::aggregate: {
      const std::string_view which = syntax.name == "min"   ? "smallest"
                                     : syntax.name == "max" ? "largest"
                                                            : "mean";
      return fmt::format("the {} {} of all {}", which, operand(syntax.children[0], Speaker::inside),
                         others(syntax, true, 1));
    }
    case SyntaxKind::distance:
      return "the distance along the facade";
    case SyntaxKind::group_gap:
      return "the gap between the members";
    case SyntaxKind::binary:
      if (is_sum(syntax)) {
        const auto side = [&](std::size_t i) {
          const std::string text = operand(syntax.children[i], speaker);
          return needs_brackets(syntax, syntax.children[i], i == 1) ? "(" + text + ")" : text;
        };
        return fmt::format("{} {} {}", side(0), arithmetic(syntax.symbol), side(1));
      }
      return say(syntax, speaker);
    default:
      return say(syntax, speaker);
  }
}

std::string ConditionWords::call(const Syntax& syntax, Speaker speaker) const {
  std::string list;
  for (std::size_t i = 0; i < syntax.children.size(); ++i) {
    if (i > 0) list += i + 1 == syntax.children.size() ? " and " : ", ";
    list += operand(syntax.children[i], speaker);
  }
  if (syntax.name == "abs") return fmt::format("the absolute value of ({})", list);
  if (syntax.name == "sqrt") return fmt::format("the square root of ({})", list);
  const bool is_pair = syntax.children.size() == 2;
  if (syntax.name == "min")
    return fmt::format("the {} of {}", is_pair ? "smaller" : "smallest", list);
  return fmt::format("the {} of {}", is_pair ? "larger" : "largest", list);
}

}  // namespace oriel::rules
