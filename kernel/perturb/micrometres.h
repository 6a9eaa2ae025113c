#pragma once

#include <cmath>
#include <cstdint>

namespace oriel::detail {

inline constexpr double kMicrometresInMetre = 1e6;

/// The nearest whole number of micrometres.
inline std::int64_t in_micrometres(double metres) {
  return std::llround(metres * kMicrometresInMetre);
}

}  // namespace oriel::detail
