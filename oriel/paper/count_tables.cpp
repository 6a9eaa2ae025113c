#include "kernel/base/text/counted.h"
#include "oriel/paper_count.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

namespace oriel {

namespace {

std::string name_of(const CountedHeuristics& row) {
  return row.count.is_used_up ? row.name + " (budget)" : row.name;
}

/// "4 holes of 2 planes, value 0.017".
std::string cut_of(const LiteralStep& step) {
  if (step.cut <= 0) return step.cut < 0 ? "nothing" : found_in(step);
  return fmt::format("{} of {}, value {:.3f}",
                     counted(static_cast<std::size_t>(step.parts), found_in(step)),
                     counted(static_cast<std::size_t>(step.cut), "plane"), step.value);
}

std::int64_t tests_of(const LiteralStep& sum) { return sum.protrusion_tests + sum.hole_tests; }

/// How many tests the heuristic saves that a row has less than the paper's own, or more.
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

}  // namespace

std::string found_in(const LiteralStep& step) {
  if (step.cut < 0) return "leaf";
  if (step.cut == 0) return step.is_hole ? "cavity" : "lumps";
  return step.is_hole ? "hole" : "protrusion";
}

CountTable first_recursion(const PaperCount& count) {
  CountTable rows{
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
  return rows;
}

CountTable all_recursions(const PaperCount& count) {
  CountTable rows{{"all recursions", "recursions", "leaves", "inner", "protrusion tests",
                   "hole tests", "saved", "features"}};
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
  return rows;
}

}  // namespace oriel
