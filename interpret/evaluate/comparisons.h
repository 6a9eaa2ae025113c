#pragma once

#include "interpret/language/expr.h"

#include <span>

namespace oriel::rules {

/// Comparisons of a block of numbers; unknown where one is NaN. `out` is as long as `x`. Compiled
/// for the registers of the machine they run on, with the same answers on all.
void compare(Op op, std::span<const double> x, std::span<const double> y, std::span<Truth> out);
/// The same with one number for all.
void compare(Op op, std::span<const double> x, double y, std::span<Truth> out);
/// low <= x <= high.
void compare_range(std::span<const double> x, double low, double high, std::span<Truth> out);

/// Whether all are numbers of a magnitude up to `most`.
bool are_all_within(std::span<const double> x, double most);
/// Whether one of many is unknown.
bool has_unknown(std::span<const Truth> truths);

}  // namespace oriel::rules
