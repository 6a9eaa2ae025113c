#pragma once

#include "interpret/evaluate/evaluator.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace oriel::rules {

/// Pairs self -> other that wait for the conditions on both.
struct Evaluator::Pairs {
  std::array<std::uint16_t, kBlock> slots;
  std::array<int, kBlock> selves;
  std::array<int, kBlock> others;
  /// Whether the other is one of the relation, and how it answered the filter.
  std::array<Truth, kBlock> is_other;
  std::array<Truth, kBlock> filtered;
  std::size_t size = 0;

  void add(std::size_t slot, int self, int other, Truth is_one, Truth answer) {
    slots[size] = static_cast<std::uint16_t>(slot);
    selves[size] = self;
    others[size] = other;
    is_other[size] = is_one;
    filtered[size++] = answer;
  }

  /// Adds a pair of which both are certain if `is_one`, without a branch that nobody could foresee.
  void add_if(bool is_one, std::size_t slot, int self, int other) {
    slots[size] = static_cast<std::uint16_t>(slot);
    selves[size] = self;
    others[size] = other;
    is_other[size] = filtered[size] = Truth::yes;
    size += is_one ? 1U : 0U;
  }

  /// The frame of the pairs; `level` is that of self.
  [[nodiscard]] Frame frame(int level) const {
    Frame frame;
    frame.size = size;
    frame.rows[static_cast<std::size_t>(level)] = selves.data();
    frame.rows[static_cast<std::size_t>(level) + 1] = others.data();
    return frame;
  }
};

}  // namespace oriel::rules
