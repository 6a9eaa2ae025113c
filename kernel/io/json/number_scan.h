#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace oriel::detail {

/// Steps through a text that ends with a zero byte.
class NumberScan {
 public:
  NumberScan(const char* from, const char* end) : at_(from), end_(end) {}

  [[nodiscard]] const char* place() const { return at_; }

  /// Passes `c`, and white space before it; false, and at rest, if it does not come.
  bool take(char c) {
    if (*at_ != c && !(is_space(*at_) && comes_behind_space(c))) return false;
    ++at_;
    return true;
  }

  /// A digit comes next, without white space before it.
  [[nodiscard]] bool is_at_digit() const { return is_digit(*at_); }

  /// Passes the digits of a whole number of JSON and white space before them. False if there is
  /// none, or one of more than 16 digits.
  bool take_digits(std::uint64_t& number) {
    const unsigned count = take_eight(number);
    if (count == 0 || count == 8) return take_others(count, number);
    return count == 1 || at_[-static_cast<int>(count)] != '0';
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  bool comes_behind_space(char c) {
    while (is_space(*at_)) ++at_;
    return *at_ == c;
  }

  /// Behind white space, or with eight digits that may have more behind them.
  bool take_others(unsigned count, std::uint64_t& number) {
    if (count == 0) {
      if (!is_space(*at_)) return false;
      while (is_space(*at_)) ++at_;
      return is_digit(*at_) && take_digits(number);
    }
    const bool starts_with_zero = at_[-8] == '0';
    std::uint64_t more = 0;
    const unsigned next = take_eight(more);
    for (unsigned i = 0; i < next; ++i) number *= 10;
    number += more;
    return !starts_with_zero && !is_digit(*at_);
  }

  /// Up to eight digits at once (D. Lemire, "Quickly parsing eight digits", 2018). Returns how
  /// many came.
  unsigned take_eight(std::uint64_t& number) {
    static_assert(std::endian::native == std::endian::little);
    std::uint64_t block = 0;
    const auto left = static_cast<std::size_t>(end_ - at_);
    if (left >= 8)
      std::memcpy(&block, at_, 8);
    else
      std::memcpy(&block, at_, left);
    block ^= 0x3030303030303030ULL;
    const std::uint64_t others = (block | (block + 0x7676767676767676ULL)) & 0x8080808080808080ULL;
    const auto count = static_cast<unsigned>(std::countr_zero(others)) / 8;
    number = 0;
    if (count == 0) return 0;
    block <<= 8 * (8 - count);
    block = block * 10 + (block >> 8U);
    number = ((block & 0x000000FF000000FFULL) * (100 + (1000000ULL << 32U)) +
              ((block >> 16U) & 0x000000FF000000FFULL) * (1 + (10000ULL << 32U))) >>
             32U;
    at_ += count;
    return count;
  }

  const char* at_;
  const char* end_;
};

}  // namespace oriel::detail
