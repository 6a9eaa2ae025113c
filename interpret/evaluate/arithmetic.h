#pragma once

#include "interpret/language/expr.h"
#include "interpret/pack/pack.h"

#include <cmath>
#include <limits>
#include <optional>
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

/// x ~ y by t: |x - y| <= t max(|x|, |y|).
inline Truth is_similar(double x, double y, double tolerance) {
  const double allowed = tolerance * std::fmax(std::abs(x), std::abs(y));
  return compare(Op::less_equal, std::abs(x - y), allowed);
}

/// The value of a constant number with params at these values (empty: those that the pack states):
/// NaN if it has none (0 / 0). Nothing if it depends on a feature, or on the map's scale and no
/// `scale` is given.
std::optional<double> fold(const Pack& pack, ExprId expr, std::span<const double> params = {},
                           std::optional<double> scale = {});

}  // namespace oriel::rules
