#pragma once

#include "examples/generator/geometry/point.h"
#include "kernel/base/random.h"

#include <cstdint>

namespace oriel::generator {

/// The library's random numbers, and lengths. Its sequence is part of what a seed stands for.
class Random : public oriel::Random {
 public:
  using oriel::Random::between;
  using oriel::Random::Random;

  /// A length in [low, high], a whole number of steps over `low`; `low` where high < low.
  Um between(Um low, Um high, Um step) {
    if (high < low) return low;
    return low +
           step * static_cast<Um>(next() % static_cast<std::uint64_t>((high - low) / step + 1));
  }
};

}  // namespace oriel::generator
