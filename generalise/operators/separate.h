#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace oriel {

/// Two things on a line: the place of the one after is greater by at least `least` than that of the
/// one before. kFixed instead of one of them: the place 0, which does not move.
struct Separation {
  static constexpr int kFixed = -1;
  int before = kFixed, after = kFixed;
  double least = 0;
};

/// Where things on a line go, or why there is no room for them.
struct Separated {
  /// Nothing: there is no room.
  std::optional<std::vector<double>> places{};
  /// Without room: numbers of separations that cannot hold together, ascending, and by how much
  /// they miss that: with any of them less by as much they could.
  std::vector<std::size_t> crowded{};
  double lacking = 0;
};

/// The places next to the wished-for ones at which all separations hold: those with the least sum
/// of squared shifts, each times its weight (positive; one for each place, or none: all are 1).
/// There is only one such solution, as the sum is strictly convex. Separations may form any graph.
///
/// Method: the dual active set method of Goldfarb and Idnani ("A numerically stable dual method for
/// solving strictly convex quadratic programs", Mathematical Programming 27, 1983), which ends
/// after finitely many steps and tells when there is no solution. Separations that hold with
/// equality form a forest, so its linear systems are sums over trees, as in Dwyer, Marriott and
/// Stuckey ("Fast node overlap removal", 2005), who solve the same programme for labels and boxes.
/// A solver of general programmes would be an additional package (Debian 12 has no OSQP, and
/// CGAL's takes rational numbers and long to compile) for what takes a page here. Time: a step for
/// each separation that becomes or ceases to be an equality, linear in places and separations. The
/// first of equally crowded separations is taken, so the same input gives the same bytes.
Separated separate(const std::vector<double>& wished, const std::vector<Separation>& separations,
                   const std::vector<double>& weights = {});

}  // namespace oriel
