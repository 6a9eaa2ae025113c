#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace oriel {

/// The SHA-256 of `text` (FIPS 180-4) as 64 small hexadecimal digits.
std::string sha256(std::string_view text);

/// The same of bytes that come piece by piece.
class Sha256 {
 public:
  void add(std::string_view bytes);
  /// Of all bytes so far; more may follow.
  [[nodiscard]] std::string digest() const;
  /// How many bytes there were.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::string rest_;  ///< of less than a block
  std::uint64_t bytes_ = 0;
};

}  // namespace oriel
