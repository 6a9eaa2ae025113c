#pragma once

#include "interpret/language/source.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace oriel::rules {

/// Why a text is not YAML, in words: what is there, what was expected, and the mended line.
struct YamlFault {
  SourceSpan where;
  std::string sentence;
};

/// The first fault in `text` on a line up to that of `stop`, where a parser gave up: a tab or a
/// wrong number of spaces before a line, a quote or bracket that is not closed, a colon, comma or
/// space that is missing, a text that needs quotes. Nothing if it is none of these.
std::optional<YamlFault> find_yaml_fault(std::string_view text, std::size_t stop);

}  // namespace oriel::rules
