#pragma once

#include "interpret/pack/rule_base.h"
#include "kernel/base/issue.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"

#include <memory>
#include <string>
#include <vector>

namespace oriel {

/// A relation that leads from a feature to others.
struct RelatedFeatures {
  std::string relation;
  /// Of a built-in one what it means; of one that the pack declares what it keeps of which one:
  /// "same facade where a ~ other.a by 10 %".
  std::string meaning;
  /// Where the pack declares it; without a line number: it is built in.
  Place place;
  /// Those of which it is certain, as the relation orders them, and their ids.
  std::vector<FeatureId> others;
  std::vector<std::string> ids;
};

/// The relations of the features of one building: the built-in ones, then those that a pack
/// declares. One of the pack hides a built-in one of its name. Pack, table and graph must outlive
/// it.
class FeatureRelations {
 public:
  FeatureRelations(const RuleBase& base, const FeatureTable& table, const FeatureGraph& graph);
  ~FeatureRelations();
  FeatureRelations(FeatureRelations&&) noexcept;
  FeatureRelations& operator=(FeatureRelations&&) noexcept;

  /// Those that lead to others.
  [[nodiscard]] std::vector<RelatedFeatures> of(FeatureId feature) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel
