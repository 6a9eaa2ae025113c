#include "kernel/base/sha256.h"

#include <array>
#include <cstdint>
#include <nettle/sha2.h>

#include <fmt/format.h>

namespace oriel {

struct Sha256::State {
  State() { nettle_sha256_init(&context); }

  sha256_ctx context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&& other) noexcept = default;
Sha256& Sha256::operator=(Sha256&& other) noexcept = default;

void Sha256::add(std::string_view bytes) {
  bytes_ += bytes.size();
  nettle_sha256_update(&state_->context, bytes.size(),
                       reinterpret_cast<const std::uint8_t*>(bytes.data()));
}

std::string Sha256::digest() const {
  sha256_ctx so_far = state_->context;  // taking the digest starts it anew
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest{};
  nettle_sha256_digest(&so_far, digest.size(), digest.data());
  std::string digits;
  for (const std::uint8_t byte : digest) digits += fmt::format("{:02x}", byte);
  return digits;
}

std::string sha256(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  return hash.digest();
}

}  // namespace oriel
