#pragma once

#include "kernel/model/ids.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel {

/// Relations between the features of one building: for each relation the pairs self -> other,
/// sorted by (self, other), without repetition and without self -> self.
class FeatureGraph {
 public:
  using Pair = std::pair<FeatureId, FeatureId>;

  /// Replaces the relation `name` by `pairs`, sorted and made unique.
  void set(const std::string& name, std::vector<Pair> pairs);

  /// The pairs of `name`; empty if there are none.
  [[nodiscard]] std::span<const Pair> pairs(std::string_view name) const;

  /// The pairs of `name` whose first is `self`, a piece of `pairs(name)`: O(log n).
  [[nodiscard]] std::span<const Pair> of(std::string_view name, FeatureId self) const;

  /// The relations that were set, by name.
  [[nodiscard]] const std::map<std::string, std::vector<Pair>, std::less<>>& all() const {
    return relations_;
  }

 private:
  std::map<std::string, std::vector<Pair>, std::less<>> relations_;
};

}  // namespace oriel
