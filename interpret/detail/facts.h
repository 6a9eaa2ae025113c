#pragma once

#include "interpret/detail/expr.h"
#include "interpret/detail/pack.h"
#include "kernel/model/feature_graph.h"
#include "kernel/model/feature_table.h"
#include "kernel/model/surface_table.h"

#include <span>
#include <vector>

namespace oriel::rules {

/// The others of a relation, packed: those of `row` are others[starts[row]] … others[starts[row +
/// 1]
/// - 1].
struct Links {
  std::vector<int> starts;
  std::vector<int> others;

  [[nodiscard]] std::span<const int> of(int row) const {
    const auto r = static_cast<std::size_t>(row);
    const auto begin = static_cast<std::size_t>(starts[r]);
    return std::span(others).subspan(begin, static_cast<std::size_t>(starts[r + 1]) - begin);
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
  /// By position in relation_schema(); empty for relations that no rule asks for.
  std::vector<Links> relations;
  /// Whether a feature is of a class, by class and row, as far as it is known so far.
  std::vector<std::vector<Truth>> membership;
  /// The column of that attribute.
  std::size_t host_inclination = 0;
  /// The denominator of the target scale, if there is one.
  double scale = 0;

 private:
  std::vector<std::vector<double>> coded_texts_;
};

}  // namespace oriel::rules
