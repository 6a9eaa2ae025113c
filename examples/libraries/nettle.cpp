// nettle: SHA-256 of what is read and written, by the processor's own instructions where it has
// them. Trap: taking the digest starts the context anew; copy it first if more bytes are to follow.
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <nettle/sha2.h>

int main() {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, 3, reinterpret_cast<const std::uint8_t*>("abc"));
  sha256_ctx copy = context;
  std::uint8_t of_copy[SHA256_DIGEST_SIZE], digest[SHA256_DIGEST_SIZE], anew[SHA256_DIGEST_SIZE];
  sha256_digest(&copy, sizeof of_copy, of_copy);
  sha256_digest(&context, sizeof digest, digest);
  sha256_digest(&context, sizeof anew, anew);
  for (const std::uint8_t byte : digest) std::printf("%02x", byte);
  std::puts("");
  const bool is_copied = std::memcmp(of_copy, digest, sizeof digest) == 0;
  const bool is_anew = std::memcmp(anew, digest, sizeof digest) != 0;
  return is_copied && is_anew && digest[0] == 0xba ? 0 : 1;
}
