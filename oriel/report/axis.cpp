#include "oriel/report/axis.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace oriel::report {

namespace {

/// So much of the range stays free at each end.
constexpr double kFree = 0.04;
/// Half the width of a range that has none, as a share of its value, and at least.
constexpr double kShareAround = 0.05;
constexpr double kLeastAround = 0.01;

struct TickStep {
  double width = 1;
  int decimals = 0;
};

/// The smallest of 1, 2 and 5 times a power of ten that is at least `least`.
TickStep step_of(double least) {
  const int power = static_cast<int>(std::floor(std::log10(least)));
  for (const int factor : {1, 2, 5}) {
    const double width = factor * std::pow(10, power);
    if (width >= least) return {width, std::max(0, -power)};
  }
  return {std::pow(10, power + 1), std::max(0, -power - 1)};
}

}  // namespace

Axis::Axis(double low, double high, double from, double to, int ticks)
    : low_(low), high_(high), from_(from), to_(to) {
  if (!(high_ > low_)) {
    const double around = std::max(kLeastAround, kShareAround * std::abs(low));
    low_ -= around;
    high_ += around;
  }
  const double free = kFree * (high_ - low_);
  low_ -= free;
  high_ += free;
  const TickStep step = step_of((high_ - low_) / ticks);
  decimals_ = step.decimals;
  const auto first = static_cast<long>(std::ceil(low_ / step.width));
  const auto last = static_cast<long>(std::floor(high_ / step.width));
  for (long i = first; i <= last; ++i) ticks_.push_back(static_cast<double>(i) * step.width);
}

double Axis::at(double value) const {
  return from_ + (value - low_) / (high_ - low_) * (to_ - from_);
}

std::string Axis::text(double tick) const { return fmt::format("{:.{}f}", tick, decimals_); }

}  // namespace oriel::report
