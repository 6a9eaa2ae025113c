#pragma once

#include "interpret/pack/rule_base.h"
#include "kernel/base/issue.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"

#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// A condition over features in the words of a pack: its attributes, relations, classes, params and
/// macros (`width > 3 m and not is window`).
class FeatureSelection {
 public:
  /// As read_selection() makes it: the last rule is the condition.
  explicit FeatureSelection(RuleBase rules) : rules_(std::move(rules)) {}

  /// The features of a building for which the condition holds, ascending. Labels that it asks for
  /// are those that interpret() gives with the pack.
  [[nodiscard]] std::vector<FeatureId> find(const FeatureTable& table,
                                            const FeatureGraph& graph) const;

 private:
  RuleBase rules_;
};

/// The condition in `text`, with the pack in `pack_text` as if it stood in the file at `pack_path`,
/// and with params at other values (with_params). Issues are the errors of the
/// condition, with codes as in packs, at their column in `text`, line 1; those of a pack that
/// cannot be loaded; there is no value then.
Checked<FeatureSelection> read_selection(const std::string& text, const std::string& pack_text,
                                         const std::string& pack_path,
                                         const std::vector<std::string>& assignments = {});

}  // namespace oriel
