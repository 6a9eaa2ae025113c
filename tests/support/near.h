#pragma once

#include <doctest/doctest.h>

namespace oriel::test {

/// Exact to what the grid of 2^-20 m leaves of decimal coordinates.
inline doctest::Approx near(double value) { return doctest::Approx(value).epsilon(1e-5); }

/// Up to the rounding of sums of doubles.
inline doctest::Approx nearly(double value) { return doctest::Approx(value).epsilon(1e-9); }

}  // namespace oriel::test
