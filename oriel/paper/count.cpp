#include "kernel/segment/segment.h"
#include "oriel/paper_count.h"

#include <utility>

namespace oriel {

namespace {

/// The rows of the table, the paper's own first.
std::vector<CountedHeuristics> heuristics_to_count() {
  return {{"paper", {}, {}},
          {"without fewest planes first", {.fewest_planes_first = false}, {}},
          {"without values below one", {.values_below_one = false}, {}},
          {"without different normals", {.different_normals = false}, {}},
          {"without equal features together", {.equal_features_together = false}, {}},
          {"brute force", {false, false, false, false, false}, {}},
          {"paper, convex bodies untested", {.convex_bodies_untested = true}, {}}};
}

}  // namespace

PaperCount count_as_paper(const Building& building, const PipelineResult& result,
                          const PipelineOptions& options) {
  PaperCount out;
  out.planes = result.solid->planes.size();
  out.counted = heuristics_to_count();
  std::vector<Heuristics> heuristics;
  for (const CountedHeuristics& row : out.counted) heuristics.push_back(row.heuristics);
  std::vector<LiteralCount> counts = count_literally(*result.solid, heuristics, result.tolerances,
                                                     kCountingBudgets * options.budget);
  for (std::size_t i = 0; i < counts.size(); ++i) out.counted[i].count = std::move(counts[i]);
  for (const Order order : {Order::paper, Order::natural}) {
    PipelineOptions in_order = options;
    in_order.order = order;
    out.orders.push_back(
        {order,
         segment(building, *result.solid, segment_options(in_order, result.tolerances)).stats});
  }
  return out;
}

}  // namespace oriel
