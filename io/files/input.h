#pragma once

#include "kernel/base/sha256.h"

#include <optional>
#include <string>
#include <string_view>

namespace oriel {

/// The bytes of a file, or of stdin for "-", in order.
class Input {
 public:
  /// The most bytes that one record may have: simdjson counts in 32 bits.
  static constexpr std::size_t kMaxBytes = 4'000'000'000;

  /// From now on the bytes that are given are hashed, too.
  void hash() { hash_.emplace(); }
  /// The SHA-256 of the bytes that were given; empty without `hash`.
  [[nodiscard]] std::string digest() const { return hash_ ? hash_->digest() : std::string(); }

  /// Opens `path`. Throws InputError E101 with the system's reason if that fails.
  explicit Input(std::string path);
  ~Input();
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  /// Everything up to the end of the input. Throws InputError E101 if reading fails, E505 beyond
  /// kMaxBytes. Room for simdjson's padding is reserved behind the text.
  std::string read_all();

  /// The next line without its line end (LF or CRLF) into `line`; false at the end of the input.
  /// Throws as `read_all`.
  bool read_line(std::string& line);

  /// The next bytes, as many as there are at hand; none at the end of the input. They stay until
  /// the next call. Throws InputError E101 if reading fails.
  std::string_view read_some();

  /// How many bytes were read so far, those that were not yet given included.
  [[nodiscard]] std::size_t bytes_read() const { return bytes_read_; }

 private:
  bool fill();

  std::string path_;
  int descriptor_ = -1;
  std::string buffer_;
  std::size_t at_ = 0;
  std::size_t bytes_read_ = 0;
  std::optional<Sha256> hash_;
};

}  // namespace oriel
