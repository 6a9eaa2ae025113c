#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace oriel {

/// The SHA-256 of `text` (FIPS 180-4) as 64 small hexadecimal digits.
std::string sha256(std::string_view text);

/// The same of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&& other) noexcept;
  Sha256& operator=(Sha256&& other) noexcept;

  void add(std::string_view bytes);
  /// Of all bytes so far; more may follow.
  [[nodiscard]] std::string digest() const;
  /// How many bytes there were.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

 private:
  struct State;
  std::unique_ptr<State> state_;  ///< none: moved from
  std::uint64_t bytes_ = 0;
};

}  // namespace oriel
