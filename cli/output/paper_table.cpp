#include "cli/output/paper_table.h"

#include "cli/terminal/table.h"
#include "kernel/base/counted.h"
#include "kernel/base/printable.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

std::string name_of(const CountedHeuristics& row) {
  return row.count.is_used_up ? row.name + " (budget)" : row.name;
}

std::string kind_of(const LiteralStep& step) {
  if (step.cut < 0) return "leaf";
  if (step.cut == 0) return step.is_hole ? "cavity" : "lumps";
  return step.is_hole ? "hole" : "protrusion";
}

/// "4 holes of 2 planes, value 0.017".
std::string cut_of(const LiteralStep& step) {
  if (step.cut <= 0) return step.cut < 0 ? "nothing" : kind_of(step);
  return fmt::format("{} of {}, value {:.3f}",
                     counted(static_cast<std::size_t>(step.parts), kind_of(step)),
                     counted(static_cast<std::size_t>(step.cut), "plane"), step.value);
}

std::int64_t tests_of(const LiteralStep& sum) { return sum.protrusion_tests + sum.hole_tests; }

/// What one thing more or less in a row saves the paper's own, or this row.
std::string saving_of(const CountedHeuristics& row, const CountedHeuristics& paper) {
  if (&row == &paper || row.count.is_used_up || paper.count.is_used_up) return "-";
  const std::int64_t difference = tests_of(row.count.sum()) - tests_of(paper.count.sum());
  return fmt::format("{}", row.heuristics.convex_bodies_untested ? -difference : difference);
}

/// The first recursion in which planes were looked at; null: there is none.
const LiteralStep* first_of(const LiteralCount& count) {
  const auto found = std::ranges::find_if(count.steps, [](const auto& s) { return s.planes > 0; });
  return found == count.steps.end() ? nullptr : &*found;
}

std::string first_recursion(const PaperCount& count) {
  std::vector<std::vector<std::string>> rows{
      {"first recursion, tested", "1 plane", "2 planes", "3 planes", "4 planes", "best"}};
  const auto add = [&](const std::string& name, const std::array<std::int64_t, 4>& numbers,
                       const std::string& cut) {
    rows.push_back({name});
    for (const std::int64_t n : numbers) rows.back().push_back(fmt::format("{}", n));
    rows.back().push_back(cut);
  };
  if (const LiteralStep* first = first_of(count.counted[0].count))
    add("combinations there are", first->combinations, "");
  for (const CountedHeuristics& row : count.counted)
    if (const LiteralStep* first = first_of(row.count))
      add(name_of(row), first->tested, cut_of(*first));
  return table(rows);
}

std::string all_recursions(const PaperCount& count) {
  std::vector<std::vector<std::string>> rows{{"all recursions", "recursions", "leaves", "inner",
                                              "protrusion tests", "hole tests", "saved",
                                              "features"}};
  const auto add = [&](const std::string& name, std::size_t leaves, std::size_t inner,
                       std::int64_t protrusions, std::int64_t holes, const std::string& saved,
                       std::int64_t features) {
    rows.push_back({name, fmt::format("{}", leaves + inner), fmt::format("{}", leaves),
                    fmt::format("{}", inner), fmt::format("{}", protrusions),
                    fmt::format("{}", holes), saved, fmt::format("{}", features)});
  };
  for (const CountedHeuristics& row : count.counted) {
    const LiteralStep sum = row.count.sum();
    add(name_of(row), row.count.leaves, row.count.inner, sum.protrusion_tests, sum.hole_tests,
        saving_of(row, count.counted[0]), sum.evaluated);
  }
  for (const CountedOrder& row : count.orders)
    add("oriel --order " + to_string(row.order), row.stats.leaves, row.stats.inner,
        static_cast<std::int64_t>(row.stats.protrusion_tests),
        static_cast<std::int64_t>(row.stats.hole_tests), "-",
        static_cast<std::int64_t>(row.stats.candidates));
  return table(rows);
}

ordered_json json_of(const LiteralStep& step) {
  return {{"planes", step.planes},
          {"combinations", step.combinations},
          {"tested", step.tested},
          {"protrusion_tests", step.protrusion_tests},
          {"hole_tests", step.hole_tests},
          {"features", step.evaluated},
          {"found", kind_of(step)},
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
                     first_recursion(count), all_recursions(count));
}

std::string paper_json(const std::string& building, const PaperCount& count) {
  ordered_json out{
      {"id", building}, {"heuristics", ordered_json::array()}, {"oriel", ordered_json::array()}};
  for (const CountedHeuristics& row : count.counted) out["heuristics"].push_back(json_of(row));
  for (const CountedOrder& row : count.orders) out["oriel"].push_back(json_of(row));
  return out.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace oriel::cli
