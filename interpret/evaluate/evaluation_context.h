#pragma once

#include "interpret/evaluate/pack_values.h"
#include "interpret/language/expr.h"
#include "interpret/pack/pack.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"
#include "model/description/surface_table.h"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace oriel::rules {

/// The others of a relation as rules see them. Refers to lists that must outlive it.
struct Links {
  const FeatureLinks* lists = nullptr;
  /// By position in the lists, whether each other is one (yes, or unknown where a value is
  /// missing); empty: all are.
  std::vector<Truth> certain;
  /// By row, whether it is one itself, as self and as other; empty: all are.
  std::vector<Truth> certain_rows;

  struct Range {
    std::size_t begin, end;
  };
  /// The others of a row stand at these positions of the lists; the row itself may be among them.
  [[nodiscard]] Range range_of(int row) const {
    const auto r = static_cast<std::size_t>(row);
    const int list = r < lists->list_of.size() ? lists->list_of[r] : -1;
    if (list < 0) return {0, 0};
    const auto l = static_cast<std::size_t>(list);
    return {static_cast<std::size_t>(lists->starts[l]),
            static_cast<std::size_t>(lists->starts[l + 1])};
  }
  /// The others of a row, without itself; none if nothing leads over the relation.
  [[nodiscard]] std::vector<int> others_of(int row) const {
    std::vector<int> rows;
    if (lists == nullptr) return rows;
    const auto [begin, end] = range_of(row);
    for (std::size_t link = begin; link < end; ++link)
      if (other(link) != row) rows.push_back(other(link));
    return rows;
  }
  [[nodiscard]] int other(std::size_t link) const { return lists->others[link]; }
  [[nodiscard]] bool are_all_certain() const { return certain.empty() && certain_rows.empty(); }
  [[nodiscard]] Truth is_other(int row, std::size_t link) const {
    const Truth one = certain.empty() ? Truth::yes : certain[link];
    return certain_rows.empty() ? one : std::min({one, of_row(row), of_row(other(link))});
  }
  [[nodiscard]] bool is_certain(int row) const {
    return certain_rows.empty() || of_row(row) == Truth::yes;
  }

 private:
  [[nodiscard]] Truth of_row(int row) const { return certain_rows[static_cast<std::size_t>(row)]; }
};

/// One building, laid out for evaluation: everything a pack asks for by name is found once, before
/// the first rule is run. Refers to the table and the graph, which must outlive it.
struct EvaluationContext {
  EvaluationContext(const Pack& pack, PackValues values, const FeatureTable& table,
                    const FeatureGraph& graph);
  /// The same for surfaces, of which neither relations nor classes are known.
  EvaluationContext(const Pack& pack, PackValues values, const SurfaceTable& table);
  EvaluationContext(const EvaluationContext&) = delete;
  EvaluationContext& operator=(const EvaluationContext&) = delete;

  /// The id of a feature.
  [[nodiscard]] const std::string& id_of(int row) const { return table_->id(FeatureId{row}); }

  /// May be set to others between evaluations.
  PackValues values;
  std::size_t rows = 0;
  /// 0, 1, … rows - 1.
  std::vector<int> row_numbers;
  /// By column of feature_schema(): its numbers, or its texts as numbers of words (Pack::words,
  /// further numbers for other texts); NaN where missing. Empty where no rule asks for it.
  std::vector<std::span<const double>> columns;
  /// By number (RelationDefinition), with the values that were given first; without lists for
  /// relations that nothing leads over.
  std::vector<Links> relations;
  /// Whether a feature is of a class, by class and row, as far as it is known so far.
  std::vector<std::vector<Truth>> membership;
  /// The same after the round before; of no size without `iterate:`.
  std::vector<std::vector<Truth>> previous;
  /// The denominator of the target scale, if there is one.
  double scale = 0;

 private:
  void link(const Pack& pack, const FeatureGraph& graph);

  /// Null where the rows are surfaces.
  const FeatureTable* table_ = nullptr;
  /// The lists of the relations that the pack declares.
  std::vector<FeatureLinks> narrowed_;
  std::vector<std::vector<double>> coded_texts_;
};

}  // namespace oriel::rules
