#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace oriel::fuzz {

/// Choices that bytes make, one byte or two a choice; when they are used up, all choices are 0.
class ByteSource {
 public:
  explicit ByteSource(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] bool is_empty() const { return at_ >= bytes_.size(); }
  int byte() {
    return is_empty() ? 0 : static_cast<int>(static_cast<unsigned char>(bytes_[at_++]));
  }
  /// 0 … n - 1 by one byte, n ≥ 1; of more than 256 by two.
  int below(int n) {
    if (n <= 1) return 0;
    return (n <= 256 ? byte() : byte() + 256 * byte()) % n;
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(below(static_cast<int>(n))); }
  /// -128 … 127.
  int step() { return static_cast<std::int8_t>(byte()); }
  bool flag() { return byte() % 2 == 1; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace oriel::fuzz
