#include "interpret/language/token_stream.h"

#include <fmt/format.h>

namespace oriel::rules {

Token TokenStream::take() {
  const Token token = peek();
  if (at_ + 1 < tokens_.size()) ++at_;
  return token;
}

bool TokenStream::take_if(Token::Kind kind) {
  if (peek().kind != kind) return false;
  take();
  return true;
}

bool TokenStream::take_if_word(std::string_view word) {
  if (!is_at_word(word)) return false;
  take();
  return true;
}

Token TokenStream::expect(Token::Kind kind, const std::string& wanted) {
  if (peek().kind != kind) fail_expecting(wanted);
  return take();
}

void TokenStream::fail(Code code, Span where, std::string sentence) {
  findings_->error(code, where, std::move(sentence));
  throw ParseStop();
}

void TokenStream::fail_expecting(const std::string& wanted) {
  const Token& found = peek();
  const bool is_end = found.kind == Token::Kind::end;
  const bool is_decimal_comma = found.kind == Token::Kind::comma && at_ > 0 &&
                                tokens_[at_ - 1].kind == Token::Kind::number &&
                                peek(1).kind == Token::Kind::number;
  fail(
      Code::R220, found.span,
      fmt::format("expected {}, found {}{}", wanted,
                  is_end ? "the end" : fmt::format("'{}'", findings_->source().text_of(found.span)),
                  is_decimal_comma ? "; decimals are written with a point: 1.5" : ""));
}

}  // namespace oriel::rules
