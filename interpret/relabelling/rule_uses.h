#pragma once

#include "interpret/pack/pack.h"
#include "interpret/relabelling/variant.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace oriel::rules {

/// What the rules of a pack depend on, found once.
class RuleUses {
 public:
  explicit RuleUses(const Pack& pack);

  /// What a change touches before any building is looked at.
  struct Affected {
    /// Rules whose conditions or scores say something else; of others the labels of other features
    /// alone may change what they say. By number, ascending.
    std::vector<int> rules;
    /// By position in `rules`: the conditions of `require` and `unless` that may say something
    /// else; nothing where the rule has other conditions.
    std::vector<std::optional<std::vector<ExprId>>> conditions;
    /// Relations that the pack declares lead to others.
    bool has_other_relations = false;
    /// Decisions are made otherwise even where all rules say the same.
    bool decides_anew = false;
  };
  [[nodiscard]] Affected affected_by(std::span<const std::size_t> params,
                                     std::span<const DroppedPart> without = {}) const;

  /// The classes that the rule asks for, ascending.
  [[nodiscard]] const std::vector<ClassId>& classes_of(int rule) const {
    return rules_[static_cast<std::size_t>(rule)].classes;
  }
  /// Whether it is run to a fixpoint, with itself or with other rules.
  [[nodiscard]] bool is_recursive(int rule) const {
    return is_recursive_[static_cast<std::size_t>(rule)];
  }

 private:
  /// What an expression, a condition, a rule or a relation depends on.
  struct Uses {
    std::vector<bool> params;
    std::vector<bool> relations;
    std::vector<ClassId> classes;
    bool has_facets = false;
  };
  /// What else another thing says.
  struct Changes {
    std::vector<bool> params;
    std::vector<bool> relations;
    bool has_other_hosts = false;
  };
  void add(ExprId id, Uses& uses) const;
  [[nodiscard]] static bool is_of(const Uses& uses, const Changes& changes);
  [[nodiscard]] Changes changes_of(std::span<const std::size_t> params) const;
  [[nodiscard]] std::vector<ExprId> conditions_of(const Rule& rule, const Changes& changes) const;
  [[nodiscard]] bool decides_anew(std::span<const DroppedPart> without,
                                  const Changes& changes) const;
  [[nodiscard]] bool is_moved(ExprId id, const Changes& changes) const;

  const Pack* pack_;
  Uses nothing_;
  std::vector<Uses> rules_;
  std::vector<bool> is_recursive_;
  /// By position in Pack::relations.
  std::vector<Uses> relations_;
};

}  // namespace oriel::rules
