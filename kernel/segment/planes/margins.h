#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace oriel::detail {

/// A margin for each of some slots, from which areas are taken off in whole runs: a tree of the
/// least margins, so that it costs the logarithm of a run's length and not the length.
class Margins {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  /// All slots have no margin to lose.
  explicit Margins(std::size_t slots) {
    while (leaves_ < slots) leaves_ *= 2;
    least_.assign(2 * leaves_, kNone);
    taken_.assign(leaves_, 0);
  }

  void set(std::size_t slot, double margin) {
    std::size_t node = slot + leaves_;
    for (std::size_t above = node / 2; above > 0; above /= 2) margin += taken_[above];
    least_[node] = margin;
    update_above(node);
  }

  /// Takes an area off the margins of the slots from `first` up to `last`.
  void take_off(std::size_t first, std::size_t last, double area) {
    if (first >= last) return;
    for (std::size_t p = first + leaves_, q = last + leaves_; p < q; p /= 2, q /= 2) {
      if (p % 2 == 1) take_off_node(p++, area);
      if (q % 2 == 1) take_off_node(--q, area);
    }
    update_above(first + leaves_);
    update_above(last - 1 + leaves_);
  }

  /// Calls `visit(slot)` for each slot whose margin is used up; it has none to lose then.
  template <class Visit>
  void take_out_spent(Visit visit) {
    while (least_[1] <= 0) {
      std::size_t node = 1;
      while (node < leaves_)
        node = least_[2 * node] <= least_[2 * node + 1] ? 2 * node : 2 * node + 1;
      visit(node - leaves_);
      set(node - leaves_, kNone);
    }
  }

 private:
  void take_off_node(std::size_t node, double area) {
    least_[node] -= area;
    if (node < leaves_) taken_[node] += area;
  }
  void update_above(std::size_t node) {
    for (node /= 2; node > 0; node /= 2)
      least_[node] = std::min(least_[2 * node], least_[2 * node + 1]) - taken_[node];
  }

  std::size_t leaves_ = 2;
  /// By node, the root is 1: the least margin below it, but for what was taken off above it.
  std::vector<double> least_;
  std::vector<double> taken_;  ///< by inner node: off all below it
};

}  // namespace oriel::detail
