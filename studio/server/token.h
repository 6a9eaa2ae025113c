#pragma once

#include <string>
#include <string_view>

namespace oriel::studio {

/// 32 hexadecimal digits out of the random numbers of the operating system. Throws
/// std::runtime_error if it gives none.
std::string random_token();

/// True if both are the same. How long it takes depends on the length of `given` only, so that
/// nobody finds a token digit by digit.
bool is_same_token(std::string_view token, std::string_view given);

}  // namespace oriel::studio
