#include "interpret/evaluate/comparisons.h"

#include "interpret/evaluate/arithmetic.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

/// The loader chooses between a function for wide registers, where GCC turns these loops into a few
/// instructions for four numbers, and one for every machine.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__)
#define ORIEL_ALSO_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define ORIEL_ALSO_WIDE
#endif
/// What is not part of such a function is compiled for every machine.
#define ORIEL_PART_OF_CALLER __attribute__((always_inline))

namespace oriel::rules {

namespace {

/// Calls `run` with the comparison as a function of two numbers.
template <class Run>
ORIEL_PART_OF_CALLER inline void with_comparison(Op op, Run run) {
  switch (op) {
    case Op::less:
      return run([](double p, double q) { return p < q; });
    case Op::less_equal:
      return run([](double p, double q) { return p <= q; });
    case Op::greater:
      return run([](double p, double q) { return p > q; });
    case Op::greater_equal:
      return run([](double p, double q) { return p >= q; });
    case Op::equal:
      return run([](double p, double q) { return p == q; });
    default:
      return run([](double p, double q) { return static_cast<bool>((p < q) | (p > q)); });
  }
}

}  // namespace

// No comparison holds for NaN, so that what does not hold is either no or, where one is NaN,
// unknown.

ORIEL_ALSO_WIDE
void compare(Op op, std::span<const double> x, std::span<const double> y, std::span<Truth> out) {
  with_comparison(op, [&](auto holds) ORIEL_PART_OF_CALLER {
    for (std::size_t i = 0; i < out.size(); ++i) {
      const int is_unknown = static_cast<int>(x[i] != x[i]) | static_cast<int>(y[i] != y[i]);
      out[i] = static_cast<Truth>(2 * static_cast<int>(holds(x[i], y[i])) + is_unknown);
    }
  });
}

ORIEL_ALSO_WIDE
void compare(Op op, std::span<const double> x, double y, std::span<Truth> out) {
  if (std::isnan(y)) {
    std::ranges::fill(out, Truth::unknown);
    return;
  }
  with_comparison(op, [&](auto holds) ORIEL_PART_OF_CALLER {
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] =
          static_cast<Truth>(2 * static_cast<int>(holds(x[i], y)) + static_cast<int>(x[i] != x[i]));
  });
}

ORIEL_ALSO_WIDE
void compare_range(std::span<const double> x, double low, double high, std::span<Truth> out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const int is_inside = static_cast<int>(x[i] >= low) & static_cast<int>(x[i] <= high);
    out[i] = static_cast<Truth>(2 * is_inside + static_cast<int>(x[i] != x[i]));
  }
  if (!std::isnan(low) && !std::isnan(high)) return;
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = std::min(compare(Op::greater_equal, x[i], low), compare(Op::less_equal, x[i], high));
}

ORIEL_ALSO_WIDE
bool are_all_within(std::span<const double> x, double most) {
  std::uint64_t is_beyond = 0;  // as wide as a double, so that many are looked at together
  for (std::size_t i = 0; i < x.size(); ++i)
    is_beyond |= static_cast<std::uint64_t>(!(std::abs(x[i]) <= most));
  return is_beyond == 0;
}

ORIEL_ALSO_WIDE
bool has_unknown(std::span<const Truth> truths) {
  std::uint8_t found = 0;
  for (const Truth truth : truths) found |= static_cast<std::uint8_t>(truth == Truth::unknown);
  return found != 0;
}

}  // namespace oriel::rules
