#pragma once

#include "interpret/language/expr.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace oriel::rules {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// An operator of one number; NaN, the unknown, stays unknown.
inline double apply(Op op, double x) {
  if (op == Op::negate) return -x;
  return op == Op::absolute ? std::abs(x) : std::sqrt(x);
}

/// An operator of two numbers; NaN, the unknown, stays unknown.
inline double apply(Op op, double x, double y) {
  switch (op) {
    case Op::add:
      return x + y;
    case Op::subtract:
      return x - y;
    case Op::multiply:
      return x * y;
    case Op::divide:
      return x / y;
    case Op::minimum:
      return std::isnan(x) || x < y ? x : y;
    default:
      return std::isnan(x) || x > y ? x : y;
  }
}

/// A comparison of two numbers; unknown if one is.
inline Truth compare(Op op, double x, double y) {
  if (std::isnan(x) || std::isnan(y)) return Truth::unknown;
  switch (op) {
    case Op::less:
      return truth_of(x < y);
    case Op::less_equal:
      return truth_of(x <= y);
    case Op::greater:
      return truth_of(x > y);
    case Op::greater_equal:
      return truth_of(x >= y);
    case Op::equal:
      return truth_of(x == y);
    default:
      return truth_of(x != y);
  }
}

/// Calls `f` for each element of spans of the same size. Compiled for each `f`, so that what is the
/// same for all elements is decided outside the loop.
template <class F, class... Spans>
void for_each(std::size_t size, F f, Spans... spans) {
  for (std::size_t i = 0; i < size; ++i) f(spans[i]...);
}

/// The same operators for a block: of x, and of x and y, into x.
inline void apply(Op op, std::span<double> x) {
  const auto run = [&](auto f) { for_each(x.size(), f, x); };
  if (op == Op::negate) return run([](double& v) { v = -v; });
  if (op == Op::absolute) return run([](double& v) { v = std::abs(v); });
  run([](double& v) { v = std::sqrt(v); });
}

inline void apply(Op op, std::span<double> x, std::span<const double> y) {
  const auto run = [&](auto f) { for_each(x.size(), f, x, y); };
  switch (op) {
    case Op::add:
      return run([](double& p, double q) { p = p + q; });
    case Op::subtract:
      return run([](double& p, double q) { p = p - q; });
    case Op::multiply:
      return run([](double& p, double q) { p = p * q; });
    case Op::divide:
      return run([](double& p, double q) { p = p / q; });
    default:
      return run([op](double& p, double q) { p = apply(op, p, q); });
  }
}

/// The same with one number for all.
inline void apply(Op op, std::span<double> x, double y) {
  const auto run = [&](auto f) { for_each(x.size(), f, x); };
  switch (op) {
    case Op::add:
      return run([y](double& p) { p = p + y; });
    case Op::subtract:
      return run([y](double& p) { p = p - y; });
    case Op::multiply:
      return run([y](double& p) { p = p * y; });
    case Op::divide:
      return run([y](double& p) { p = p / y; });
    default:
      return run([op, y](double& p) { p = apply(op, p, y); });
  }
}

/// x ~ y by t: |x - y| <= t max(|x|, |y|).
inline Truth is_similar(double x, double y, double tolerance) {
  const double allowed = tolerance * std::fmax(std::abs(x), std::abs(y));
  return compare(Op::less_equal, std::abs(x - y), allowed);
}

}  // namespace oriel::rules
