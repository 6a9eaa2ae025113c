#pragma once

#include <cstddef>
#include <string_view>

namespace oriel {

/// How many edits make one text of the other: a character inserted, deleted or replaced, or two
/// neighbours swapped, none of them edited twice (optimal string alignment). Symmetric; 0 only for
/// the same texts. Characters are bytes. The time grows with the product of the lengths: callers
/// bound them.
std::size_t edit_distance(std::string_view from, std::string_view to);

}  // namespace oriel
