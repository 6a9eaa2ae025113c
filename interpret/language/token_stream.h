#pragma once

#include "interpret/language/findings.h"
#include "interpret/language/lexer.h"

#include <algorithm>
#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel::rules {

/// Ends the parse of one expression; what was wrong is among the findings.
struct ParseStop : std::exception {};

/// The tokens of one expression, eaten from the front.
class TokenStream {
 public:
  TokenStream(std::vector<Token> tokens, Findings& findings)
      : tokens_(std::move(tokens)), findings_(&findings) {}

  /// The token `ahead` of the next one; past the end the end token.
  [[nodiscard]] const Token& peek(std::size_t ahead = 0) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  [[nodiscard]] bool is_at_word(std::string_view word) const {
    return peek().kind == Token::Kind::word && peek().text == word;
  }

  Token take();
  bool take_if(Token::Kind kind);
  bool take_if_word(std::string_view word);
  /// The next token, which must be of that kind.
  Token expect(Token::Kind kind, const std::string& wanted);

  [[noreturn]] void fail(Code code, Span where, std::string sentence);
  /// R220: `wanted` was expected here.
  [[noreturn]] void fail_expecting(const std::string& wanted);

 private:
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  Findings* findings_;
};

}  // namespace oriel::rules
