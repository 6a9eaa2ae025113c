#pragma once

#include "kernel/base/ids.h"
#include "model/description/feature_links.h"
#include "model/description/feature_table.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel {

/// Relations between the features of one building, whose rows their ids are: for each relation
/// the others of every feature.
class FeatureGraph {
 public:
  using Pair = std::pair<FeatureId, FeatureId>;

  /// Replaces the relation `name` by the pairs self -> other. Repeated pairs count once, those of a
  /// feature with itself not at all. Throws std::invalid_argument for an id below 0.
  void set(const std::string& name, std::vector<Pair> pairs);
  /// The same where features of one class are all related to each other; class -1: to none. So many
  /// numbers are kept as there are features, not pairs; also where pairs say the same.
  void set_classes(const std::string& name, std::span<const int> class_of_row);

  /// The links of `name`; of no list if it was not set.
  [[nodiscard]] const FeatureLinks& links(std::string_view name) const;
  /// The others of `self` by `name`, ascending.
  [[nodiscard]] std::vector<FeatureId> others(std::string_view name, FeatureId self) const;
  /// All pairs of `name`, sorted by (self, other).
  [[nodiscard]] std::vector<Pair> pairs(std::string_view name) const;
  /// The relations that were set, sorted.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::map<std::string, FeatureLinks, std::less<>> relations_;
};

/// A building as rules see it.
struct DescribedBuilding {
  FeatureTable table;
  FeatureGraph graph;
};

}  // namespace oriel
