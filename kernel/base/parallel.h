#pragma once

#include <cstddef>
#include <functional>

namespace oriel {

/// Calls work(0) … work(count - 1), each once, in any order, perhaps on several threads; returns
/// when all are done. What comes of it must not depend on the order.
using ForEachShare =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

/// One after the other.
inline void for_each_in_turn(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

}  // namespace oriel
