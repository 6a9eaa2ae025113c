#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

namespace oriel {

/// Calls work(0) … work(count - 1), each once, in any order, perhaps on several threads; returns
/// when all are done. What comes of it must not depend on the order.
using ForEachShare =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

/// One after the other.
inline void for_each_in_turn(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = 0; i < count; ++i) work(i);
}

/// True if nobody waits for an answer any longer; is asked often, of work in shares from any of its
/// threads. Null: somebody does.
using IsGivenUp = std::function<bool()>;

/// Asks that until it was true once: what was given up stays so.
inline IsGivenUp for_good(IsGivenUp ask) {
  return [ask = std::move(ask), was = std::make_shared<std::atomic<bool>>(false)] {
    if (!*was && ask && ask()) *was = true;
    return was->load();
  };
}

}  // namespace oriel
