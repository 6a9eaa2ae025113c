#pragma once

#include "kernel/base/text/numbers.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace oriel::detail {

/// A key for a plane with an integer normal.
inline std::uint64_t table_key(const std::array<std::int64_t, 3>& normal, std::int64_t offset) {
  std::uint64_t key = static_cast<std::uint64_t>(offset);
  for (const std::int64_t c : normal) {
    key = (key ^ static_cast<std::uint64_t>(c)) * 0xBF58476D1CE4E5B9ULL;
    key ^= key >> 32;
  }
  return key;
}

/// Numbers found by what they stand for: an open hash table. What a number stands for is kept by
/// the caller.
class NumberTable {
 public:
  /// For no more than `places` numbers; quick if they are no more than half as many.
  explicit NumberTable(std::size_t places)
      : numbers_(std::bit_ceil(places + 2), -1), shift_(64 - std::countr_zero(numbers_.size())) {}

  /// The number with that key for which `is_same(number)`; or the place for a new one, -1.
  template <class IsSame>
  int& at(std::uint64_t key, IsSame is_same) {
    return numbers_[slot_of(key, is_same)];
  }
  template <class IsSame>
  [[nodiscard]] int find(std::uint64_t key, IsSame is_same) const {
    return numbers_[slot_of(key, is_same)];
  }

 private:
  template <class IsSame>
  [[nodiscard]] std::size_t slot_of(std::uint64_t key, IsSame is_same) const {
    std::size_t slot = (key * 0x9E3779B97F4A7C15ULL) >> shift_;
    while (numbers_[slot] >= 0 && !is_same(numbers_[slot]))
      slot = (slot + 1) & (numbers_.size() - 1);
    return slot;
  }

  Numbers numbers_;
  int shift_;
};

}  // namespace oriel::detail
