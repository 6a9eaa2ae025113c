#include "interpret/language/lexer.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

struct Symbol {
  std::string_view text;
  Token::Kind kind;
};

/// Longer symbols before those that begin like them.
constexpr std::array<Symbol, 19> kSymbols = {{{"..", Token::Kind::range},
                                              {"<=", Token::Kind::less_equal},
                                              {">=", Token::Kind::greater_equal},
                                              {"!=", Token::Kind::not_equal},
                                              {"<", Token::Kind::less},
                                              {">", Token::Kind::greater},
                                              {"=", Token::Kind::equal},
                                              {"~", Token::Kind::tilde},
                                              {"+", Token::Kind::plus},
                                              {"-", Token::Kind::minus},
                                              {"*", Token::Kind::star},
                                              {"/", Token::Kind::slash},
                                              {"(", Token::Kind::open_round},
                                              {")", Token::Kind::close_round},
                                              {"[", Token::Kind::open_square},
                                              {"]", Token::Kind::close_square},
                                              {",", Token::Kind::comma},
                                              {".", Token::Kind::dot},
                                              {"%", Token::Kind::percent}}};

/// Symbols of other languages and what to write here.
struct Foreign {
  std::string_view text;
  std::string_view advice;
};
constexpr std::array<Foreign, 7> kForeign = {{{"==", "write '='"},
                                              {"<>", "write '!='"},
                                              {"=<", "write '<='"},
                                              {"=>", "write '>='"},
                                              {"&&", "write 'and'"},
                                              {"||", "write 'or'"},
                                              {"**", "powers are written as products: a * a"}}};
/// The same for single characters, where no symbol of ours begins.
constexpr std::array<Foreign, 10> kForeignCharacters = {
    {{"!", "write 'not'"},
     {":", "write '='"},
     {"&", "write 'and'"},
     {"|", "write 'or'"},
     {"°", "write 'deg'"},
     {"²", "write 'm2' for m²"},
     {"³", "write 'm3' for m³"},
     {"^", "powers are written as products: a * a"},
     {"≤", "write '<='"},
     {"≥", "write '>='"}}};

class Lexer {
 public:
  Lexer(SourceSpan where, Findings& findings)
      : text_(findings.source().text_of(where)), base_(where.begin), findings_(&findings) {}

  std::optional<std::vector<Token>> run() {
    std::vector<Token> tokens;
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
      const auto token = next();
      if (!token) return std::nullopt;
      tokens.push_back(*token);
    }
    tokens.push_back(make(Token::Kind::end, 0));
    return tokens;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  /// The token of the next `length` bytes, which are eaten.
  Token make(Token::Kind kind, std::size_t length) {
    const SourceSpan span{base_ + at_, base_ + at_ + length};
    const Token token{kind, text_.substr(at_, length), 0, span};
    at_ += length;
    return token;
  }

  std::optional<Token> fail(std::size_t length, std::string sentence) {
    findings_->error(Code::R220, {base_ + at_, base_ + at_ + length}, std::move(sentence));
    return std::nullopt;
  }

  std::optional<Token> next() {
    if (is_digit(peek())) return number();
    if (is_letter(peek())) return word();
    if (peek() == '$') return parameter();
    return symbol();
  }

  std::optional<Token> number() {
    std::size_t length = digits(0);
    if (peek(length) == '.' && is_digit(peek(length + 1))) length = digits(length + 1);
    const bool has_exponent = peek(length) == 'e' || peek(length) == 'E';
    const std::size_t sign = peek(length + 1) == '-' || peek(length + 1) == '+' ? 1 : 0;
    if (has_exponent && is_digit(peek(length + 1 + sign))) length = digits(length + 1 + sign);
    double value = 0;
    const char* begin = text_.data() + at_;
    const auto result = std::from_chars(begin, begin + length, value);
    if (result.ec != std::errc() || !std::isfinite(value))
      return fail(length, "this number is too large or too small");
    Token token = make(Token::Kind::number, length);
    token.number = value;
    return token;
  }
  [[nodiscard]] std::size_t digits(std::size_t from) const {
    while (is_digit(peek(from))) ++from;
    return from;
  }

  [[nodiscard]] std::size_t word_length(std::size_t from) const {
    std::size_t length = from;
    while (is_letter(peek(length)) || is_digit(peek(length))) ++length;
    return length - from;
  }
  std::optional<Token> word() {
    constexpr std::string_view kMapUnit = "mm@map";
    const std::size_t length = word_length(0);
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with(kMapUnit) && length == 2 && word_length(3) == 3)
      return make(Token::Kind::map_unit, kMapUnit.size());
    return make(Token::Kind::word, length);
  }

  std::optional<Token> parameter() {
    const std::size_t length = word_length(1);
    if (length == 0) return fail(1, "after '$' comes the name of a param");
    Token token = make(Token::Kind::parameter, length + 1);
    token.text.remove_prefix(1);
    return token;
  }

  std::optional<Token> symbol() {
    const std::string_view rest = text_.substr(at_);
    for (const Foreign& foreign : kForeign)
      if (rest.starts_with(foreign.text))
        return fail(foreign.text.size(), fmt::format("'{}': {}", foreign.text, foreign.advice));
    for (const Symbol& symbol : kSymbols)
      if (rest.starts_with(symbol.text)) return make(symbol.kind, symbol.text.size());
    return fail_at_character();
  }

  std::optional<Token> fail_at_character() {
    std::size_t length = 1;
    while ((static_cast<unsigned char>(peek(length)) & 0xC0U) == 0x80U) ++length;
    const std::string_view shown = text_.substr(at_, length);
    if (shown == "\"" || shown == "'")
      return fail(length,
                  "quotes have no meaning in an expression; words are written without them: write "
                  "'sense = hole'");
    for (const Foreign& foreign : kForeignCharacters)
      if (shown == foreign.text)
        return fail(length, fmt::format("'{}': {}", foreign.text, foreign.advice));
    return fail(length, fmt::format("'{}' has no meaning in an expression", shown));
  }

  std::string_view text_;
  std::size_t base_;
  std::size_t at_ = 0;
  Findings* findings_;
};

}  // namespace

std::optional<std::vector<Token>> tokenise(SourceSpan where, Findings& findings) {
  return Lexer(where, findings).run();
}

}  // namespace oriel::rules
