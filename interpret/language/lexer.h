#pragma once

#include "interpret/language/findings.h"
#include "interpret/language/source.h"

#include <optional>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// The smallest pieces of an expression.
struct Token {
  enum class Kind {
    number,
    word,
    parameter,  ///< $name; `text` is the name
    less,
    less_equal,
    greater,
    greater_equal,
    equal,
    not_equal,
    tilde,
    plus,
    minus,
    star,
    slash,
    open_round,
    close_round,
    open_square,
    close_square,
    comma,
    dot,
    range,  ///< ..
    percent,
    map_unit,  ///< mm@map
    end
  };
  Kind kind = Kind::end;
  std::string_view text;
  double number = 0;
  SourceSpan span;
};

/// The tokens of the expression at `where` in the text of `findings.source()`, with an end token
/// last; or nothing and an error R220.
std::optional<std::vector<Token>> tokenise(SourceSpan where, Findings& findings);

}  // namespace oriel::rules
