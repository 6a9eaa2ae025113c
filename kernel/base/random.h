#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace oriel {

/// A small generator of pseudo-random numbers (splitmix64): unlike std::uniform_*_distribution it
/// gives the same sequence on every platform. Files and reports depend on it: it never changes.
class Random {
 public:
  /// Two streams of one seed share nothing.
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : state_(seed) {
    state_ = next() ^ (stream * 0xd1342543de82ef95U + 1);
  }

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }
  /// One of 0 … count − 1; `count` > 0.
  int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
  /// One of low, low + 1, …, high.
  int between(int low, int high) { return low + below(high - low + 1); }
  /// A number in [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
  /// True with the given probability.
  bool chance(double probability) { return unit() < probability; }
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t left = items.size(); left > 1; --left)
      std::swap(items[left - 1], items[next() % left]);
  }

 private:
  std::uint64_t state_;
};

}  // namespace oriel
