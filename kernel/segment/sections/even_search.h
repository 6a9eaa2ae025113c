#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace oriel::detail {

/// The place of the first of some sorted values whose projection is not less than `value`; their
/// number if there is none. As std::lower_bound, but with the way chosen by arithmetic: where one
/// searches for something else each time no processor can guess it.
template <class T, class Value, class Projection = std::identity>
std::size_t first_not_less(std::span<const T> sorted, const Value& value,
                           Projection projection = {}) {
  std::size_t first = 0;
  for (std::size_t left = sorted.size(); left > 0;) {
    const std::size_t half = (left + 1) / 2;
    const bool is_less = std::invoke(projection, sorted[first + half - 1]) < value;
    first += half * static_cast<std::size_t>(is_less);
    left -= half;
  }
  return first;
}

}  // namespace oriel::detail
