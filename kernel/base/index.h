#pragma once

#include <cstddef>

namespace oriel {

/// An index as the size type of a list. Needs i ≥ 0.
constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace oriel
