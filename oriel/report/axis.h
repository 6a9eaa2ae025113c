#pragma once

#include <string>
#include <vector>

namespace oriel::report {

/// A straight scale of values with round numbers along it.
class Axis {
 public:
  /// Reaches from `low` to `high` and a little beyond, on a drawing from `from` to `to`; with about
  /// `ticks` round numbers. A range without width gets one.
  Axis(double low, double high, double from, double to, int ticks);

  /// Where a value is drawn.
  [[nodiscard]] double at(double value) const;
  [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }
  /// "0.85", with as many decimals as the distance of the numbers needs.
  [[nodiscard]] std::string text(double tick) const;

 private:
  double low_, high_, from_, to_;
  int decimals_ = 0;
  std::vector<double> ticks_;
};

}  // namespace oriel::report
