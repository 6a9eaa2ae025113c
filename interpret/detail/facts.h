#pragma once

#include "interpret/detail/expr.h"
#include "interpret/detail/pack.h"
#include "kernel/model/feature_graph.h"
#include "kernel/model/feature_table.h"
#include "kernel/model/surface_table.h"

#include <span>
#include <vector>

namespace oriel::rules {

/// The others of a relation, packed: those of a row r are others[starts[r]] … others[starts[r + 1]
/// - 1].
struct Links {
  std::vector<int> starts;
  std::vector<int> others;
  /// Whether each of `others` is one (yes, or unknown where a value is missing); empty: all are.
  std::vector<Truth> certain;

  [[nodiscard]] std::size_t begin_of(int row) const {
    return static_cast<std::size_t>(starts[static_cast<std::size_t>(row)]);
  }
  [[nodiscard]] std::span<const int> of(int row) const {
    return std::span(others).subspan(begin_of(row), begin_of(row + 1) - begin_of(row));
  }
  [[nodiscard]] Truth is_other(std::size_t link) const {
    return certain.empty() ? Truth::yes : certain[link];
  }
};

/// One building, laid out for evaluation: everything a pack asks for by name is found once, before
/// the first rule is run. Refers to the table, which must outlive it.
struct Facts {
  Facts(const Pack& pack, const FeatureTable& table, const FeatureGraph& graph);
  /// The same for surfaces, of which neither relations nor classes are known.
  Facts(const Pack& pack, const SurfaceTable& table);
  Facts(const Facts&) = delete;
  Facts& operator=(const Facts&) = delete;

  std::size_t rows = 0;
  /// 0, 1, … rows - 1: a block of features is a piece of it.
  std::vector<int> row_numbers;
  /// By column of feature_schema(): its numbers, or its texts as numbers of words (Pack::words,
  /// further numbers for other texts); NaN where missing. Empty for texts that no rule asks for.
  std::vector<std::span<const double>> columns;
  /// By number (Relation); empty for relations that nothing leads over.
  std::vector<Links> relations;
  /// Whether a feature is of a class, by class and row, as far as it is known so far.
  std::vector<std::vector<Truth>> membership;
  /// The same after the round before; of no size without `iterate:`.
  std::vector<std::vector<Truth>> previous;
  /// The column of that attribute.
  std::size_t host_inclination = 0;
  /// The denominator of the target scale, if there is one.
  double scale = 0;

 private:
  void link(const Pack& pack, const FeatureGraph& graph);

  std::vector<std::vector<double>> coded_texts_;
};

}  // namespace oriel::rules
