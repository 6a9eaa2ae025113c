#include "interpret/language/parser.h"

#include "interpret/language/pratt.h"

#include <utility>

namespace oriel::rules {

namespace {

/// What `parse` makes of the expression at `where`, or nothing and an error.
template <class Result>
std::optional<Result> parse_at(Span where, Findings& findings, Result (*parse)(Pratt&)) {
  if (where.end - where.begin > kLongestExpression) {
    findings.error(Code::R222, {where.begin, where.begin},
                   "an expression is no longer than 1000 characters; use macros");
    return std::nullopt;
  }
  auto tokens = tokenise(where, findings);
  if (!tokens) return std::nullopt;
  Pratt pratt(std::move(*tokens), findings);
  try {
    Result result = parse(pratt);
    pratt.expect_end();
    return result;
  } catch (const ParseStop&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Syntax> parse_expression(Span where, Findings& findings) {
  return parse_at<Syntax>(where, findings,
                          [](Pratt& pratt) { return pratt.expression(Power::loosest); });
}

std::optional<RangeSyntax> parse_range(Span where, Findings& findings) {
  return parse_at<RangeSyntax>(where, findings, [](Pratt& pratt) { return pratt.range(); });
}

}  // namespace oriel::rules
