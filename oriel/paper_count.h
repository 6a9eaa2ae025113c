#pragma once

#include "kernel/literal/literal.h"  // IWYU pragma: export
#include "model/building.h"
#include "oriel/options.h"
#include "oriel/result.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace oriel {

/// What the paper's algorithm does to a building with some of its heuristics.
struct CountedHeuristics {
  /// "paper" (all of the paper's), "paper, convex bodies untested", "without …", "brute force"
  /// (none).
  std::string name;
  Heuristics heuristics;
  LiteralCount count;
};

/// What segment() does to it.
struct CountedOrder {
  Order order = Order::natural;
  SegmentationStats stats;
};

/// How many planes, and sets of planes, are tested: the paper's figures (section 4) for any
/// building, beside oriel's.
struct PaperCount {
  /// Oriented planes of the building's solid.
  std::size_t planes = 0;
  std::vector<CountedHeuristics> counted;
  /// In the paper's order and in the natural one.
  std::vector<CountedOrder> orders;
};

/// Each count may take so many times the steps of a stage: they are small, and what the paper calls
/// brute force takes many.
inline constexpr std::int64_t kCountingBudgets = 2;

/// Counts what the paper's algorithm does to a building: with its heuristics, with each of them
/// left out, and with none. `result` is what segment() or label() said of it, is_done() and not
/// open. Each count ends after kCountingBudgets × `options.budget` steps; its is_used_up says so.
PaperCount count_as_paper(const Building& building, const PipelineResult& result,
                          const PipelineOptions& options = {});

/// What a recursion found: "protrusion", "hole", "cavity", "lumps", or "leaf": nothing.
std::string found_in(const LiteralStep& step);

/// Rows of texts, the first of them the heads of the columns.
using CountTable = std::vector<std::vector<std::string>>;

/// The planes, and sets of planes, that the first recursion tests: a row for what there are, then
/// one for each of `count.counted`.
CountTable first_recursion(const PaperCount& count);

/// What all recursions come to: a row for each of `count.counted`, then for each of `count.orders`.
CountTable all_recursions(const PaperCount& count);

}  // namespace oriel
