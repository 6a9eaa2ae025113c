#pragma once

#include "kernel/base/index.h"
#include "kernel/base/text/numbers.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace oriel {

/// Disjoint sets of 0…size-1, each known by its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// Adds a set of one.
  void add() { parent_.push_back(static_cast<int>(parent_.size())); }

  int find(int i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void unite(int i, int j) {
    i = find(i);
    j = find(j);
    parent_[at(std::max(i, j))] = std::min(i, j);
  }

 private:
  Numbers parent_;
};

}  // namespace oriel
