#pragma once

#include "interpret/language/findings.h"
#include "interpret/language/syntax.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::rules {

/// What one expression may be at most.
inline constexpr std::size_t kLongestExpression = 1000;
inline constexpr int kDeepestExpression = 64;

/// The expression at `where` in the text of `findings.source()`, or nothing and an error: R220
/// (what was found and what was expected), R222 (too long or too deep), R233 (unknown unit).
std::optional<Syntax> parse_expression(Span where, Findings& findings);

/// The range `lo .. hi` at `where`, with the same errors.
std::optional<RangeSyntax> parse_range(Span where, Findings& findings);

/// The words that expressions are made of; nothing else can carry their names.
const std::vector<std::string>& reserved_words();

}  // namespace oriel::rules
