#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace oriel::literal {

/// A set of small numbers.
class Bits {
 public:
  Bits() = default;
  explicit Bits(std::size_t size) : words_((size + 63) / 64, 0) {}

  [[nodiscard]] bool has(int i) const { return (words_[word(i)] >> bit(i) & 1U) != 0; }
  void add(int i) { words_[word(i)] |= std::uint64_t{1} << bit(i); }
  void drop(int i) { words_[word(i)] &= ~(std::uint64_t{1} << bit(i)); }

  [[nodiscard]] bool is_empty() const {
    for (const std::uint64_t w : words_)
      if (w != 0) return false;
    return true;
  }
  /// Calls act(i) for each number in it, ascending.
  template <class Act>
  void for_each(Act act) const {
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t rest = words_[w]; rest != 0; rest &= rest - 1)
        act(static_cast<int>(w * 64) + std::countr_zero(rest));
  }
  /// The least number in it; -1 if it is empty.
  [[nodiscard]] int first() const {
    for (std::size_t w = 0; w < words_.size(); ++w)
      if (words_[w] != 0) return static_cast<int>(w * 64) + std::countr_zero(words_[w]);
    return -1;
  }
  /// Both have the same size.
  Bits& operator&=(const Bits& other) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= other.words_[w];
    return *this;
  }
  Bits& operator|=(const Bits& other) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] |= other.words_[w];
    return *this;
  }
  Bits& operator-=(const Bits& other) {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= ~other.words_[w];
    return *this;
  }
  friend bool operator==(const Bits&, const Bits&) = default;
  friend auto operator<=>(const Bits&, const Bits&) = default;

  [[nodiscard]] const std::vector<std::uint64_t>& words() const { return words_; }

  struct Hash {
    std::size_t operator()(const Bits& bits) const {
      std::uint64_t hash = 0;
      for (const std::uint64_t w : bits.words_) {
        hash = (hash ^ w) * 0x9e3779b97f4a7c15U;
        hash ^= hash >> 32U;
      }
      return static_cast<std::size_t>(hash);
    }
  };

 private:
  static std::size_t word(int i) { return static_cast<std::size_t>(i) / 64; }
  static unsigned bit(int i) { return static_cast<unsigned>(i) % 64; }

  std::vector<std::uint64_t> words_;
};

}  // namespace oriel::literal
