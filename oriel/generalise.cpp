#include "oriel/generalise.h"

#include "oriel/pipeline/building_drawer.h"
#include "oriel/pipeline/pipeline.h"

#include <algorithm>
#include <utility>

namespace oriel {

namespace {

/// It could not be drawn as a valid solid of its own.
bool is_invalid(const GeneralisedBuilding& drawn) {
  return std::ranges::any_of(drawn.issues, [](const Issue& issue) {
    return issue.code == Code::G413 || issue.code == Code::G410;
  });
}

bool has_installation(const Redrawn& level, const std::string& id) {
  const auto& list = level.labelled.installations;
  return std::ranges::find(list, id, &Installation::id) != list.end();
}

}  // namespace

GeneralisedBuilding generalise(const Document& document, const Building& building,
                               const PipelineResult& result, const RuleBase& rules,
                               const Targets& targets, const GeneraliseOptions& options) {
  GeneralisedBuilding drawn;
  drawn.building = building.id;
  if (!result.is_done()) return drawn;
  if (result.is_open) {
    drawn.issues.push_back(building_issue(Severity::error, Code::G404, building.id,
                                          "is open: there is no solid to redraw"));
    return drawn;
  }
  const BuildingDrawer drawer(document, building, rules, targets, options);
  drawn = measure(options.observer, Stage::generalise, [&] { return drawer.draw(result); });
  measure(options.observer, Stage::write, [&] { drawer.keep_valid(result, drawn); });
  if (is_invalid(drawn)) drawer.repair(result, drawn);
  return drawn;
}

void add(GeneralisedBuilding building, OutputRecord& output) {
  for (std::size_t i = 0; i < building.levels.size(); ++i) {
    Redrawn& level = building.levels[i];
    for (const std::string& id : level.removed_ids)
      if (std::ranges::none_of(building.levels,
                               [&](const Redrawn& other) { return has_installation(other, id); }))
        output.options.removed.push_back(id);
    if (i > 0) level.labelled.attributes.clear();
  }
  for (Redrawn& level : building.levels) output.buildings.push_back(std::move(level.labelled));
}

}  // namespace oriel
