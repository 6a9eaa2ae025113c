#pragma once

#include "interpret/labelling/interpret.h"  // IWYU pragma: export
#include "interpret/labelling/selection.h"  // IWYU pragma: export
#include "interpret/pack/rule_base.h"
#include "interpret/score/label_diff.h"
#include "io/records/feature_records.h"
#include "io/records/feature_tables.h"
#include "kernel/base/issue.h"
#include "model/description/feature_graph.h"
#include "model/interpretation.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// Names features that are stored, such as those that read_feature_tables() gives: one
/// Interpretation for each building, in their order, with what label() would say of the building.
/// Buildings do not depend on each other, so shares of them may be interpreted by several threads.
std::vector<Interpretation> interpret(const RuleBase& rules,
                                      std::span<const DescribedBuilding> buildings);

/// The columns of a table of features that rules read: attributes, relations and the host.
RecordColumns columns_read(const RuleBase& rules);
/// The names of those that a table with `columns` lacks: their features count as without a value.
std::vector<std::string> columns_lacking(const RuleBase& rules, const RecordColumns& columns);

/// A warning E151 if a table with these columns lacks some that the pack reads.
std::optional<Issue> lacks_columns(const std::string& file, const RecordColumns& columns,
                                   const RuleBase& rules);

/// What two packs say of the same buildings: `before` and `after` are what interpret() made of
/// them. So many examples of each change are kept.
LabelDiff diff_labels(std::span<const DescribedBuilding> buildings,
                      std::span<const Interpretation> before, std::span<const Interpretation> after,
                      std::size_t most_examples = 3);

/// Puts new verdicts into stored records, which come in the order of their files, as
/// read_feature_tables() had them. Refers to buildings and run, what interpret() made of them.
class RecordLabeller {
 public:
  RecordLabeller(std::span<const DescribedBuilding> buildings, std::span<const Interpretation> run)
      : buildings_(buildings), run_(run) {}

  /// Gives the record the verdict of its feature in place of what it says. False, and nothing
  /// changes, for a record that is not among the buildings: it could not be read as a table.
  bool label(FeatureRecord& record);

 private:
  std::optional<std::size_t> find(const FeatureRecord& record);
  void know_building();

  std::span<const DescribedBuilding> buildings_;
  std::span<const Interpretation> run_;
  std::size_t building_ = 0;
  std::size_t row_ = 0;               ///< after the last one found
  std::optional<std::size_t> known_;  ///< the building of which that is known:
  std::vector<std::vector<std::string>> groups_;
  std::vector<FeatureId> wholes_;
};

}  // namespace oriel
