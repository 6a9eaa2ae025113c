#include "studio/server/token.h"

#include <array>
#include <cerrno>
#include <stdexcept>
#include <sys/random.h>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::studio {

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  // So few bytes come whole or not at all.
  while (::getrandom(bytes.data(), bytes.size(), 0) < 0)
    if (errno != EINTR)
      throw std::runtime_error("the system gives no random numbers: " +
                               std::generic_category().message(errno));
  return fmt::format("{:02x}", fmt::join(bytes, ""));
}

bool is_same_token(std::string_view token, std::string_view given) {
  if (token.empty()) return false;
  unsigned difference = token.size() == given.size() ? 0U : 1U;
  for (std::size_t i = 0; i < given.size(); ++i)
    difference |= static_cast<unsigned>(token[i % token.size()] ^ given[i]);
  return difference == 0;
}

}  // namespace oriel::studio
