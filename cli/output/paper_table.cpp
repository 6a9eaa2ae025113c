#include "cli/output/paper_table.h"

#include "cli/terminal/table.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

ordered_json json_of(const LiteralStep& step) {
  return {{"planes", step.planes},
          {"combinations", step.combinations},
          {"tested", step.tested},
          {"protrusion_tests", step.protrusion_tests},
          {"hole_tests", step.hole_tests},
          {"features", step.evaluated},
          {"found", found_in(step)},
          {"cut_planes", std::max(step.cut, 0)},
          {"value", step.cut > 0 ? ordered_json(step.value) : ordered_json(nullptr)},
          {"parts", step.parts}};
}

ordered_json json_of(const CountedHeuristics& row) {
  const LiteralStep sum = row.count.sum();
  ordered_json out{{"name", row.name},
                   {"fewest_planes_first", row.heuristics.fewest_planes_first},
                   {"values_below_one", row.heuristics.values_below_one},
                   {"different_normals", row.heuristics.different_normals},
                   {"equal_features_together", row.heuristics.equal_features_together},
                   {"convex_bodies_untested", row.heuristics.convex_bodies_untested},
                   {"is_used_up", row.count.is_used_up},
                   {"leaves", row.count.leaves},
                   {"inner", row.count.inner},
                   {"combinations", sum.combinations},
                   {"tested", sum.tested},
                   {"protrusion_tests", sum.protrusion_tests},
                   {"hole_tests", sum.hole_tests},
                   {"features", sum.evaluated},
                   {"recursions", ordered_json::array()}};
  for (const LiteralStep& step : row.count.steps) out["recursions"].push_back(json_of(step));
  return out;
}

ordered_json json_of(const CountedOrder& row) {
  return {{"order", to_string(row.order)},      {"leaves", row.stats.leaves},
          {"inner", row.stats.inner},           {"protrusion_tests", row.stats.protrusion_tests},
          {"hole_tests", row.stats.hole_tests}, {"features", row.stats.candidates}};
}

}  // namespace

std::string paper_table(const std::string& building, const PaperCount& count) {
  return fmt::format("{}: {}\n{}\n{}", printable(building), counted(count.planes, "plane"),
                     table(first_recursion(count)), table(all_recursions(count)));
}

std::string paper_json(const std::string& building, const PaperCount& count) {
  ordered_json out{
      {"id", building}, {"heuristics", ordered_json::array()}, {"oriel", ordered_json::array()}};
  for (const CountedHeuristics& row : count.counted) out["heuristics"].push_back(json_of(row));
  for (const CountedOrder& row : count.orders) out["oriel"].push_back(json_of(row));
  return out.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace oriel::cli
