#include "oriel/generalise.h"

#include "oriel/pipeline/building_drawer.h"
#include "oriel/pipeline/pipeline.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// It could not be drawn as a valid solid of its own.
bool is_invalid(const GeneralisedBuilding& drawn) {
  return std::ranges::any_of(drawn.issues, [](const Issue& issue) {
    return issue.code == Code::G413 || issue.code == Code::G410;
  });
}

GeneralisedBuilding valid_drawing(const BuildingDrawer& drawer, const PipelineResult& result,
                                  const StageObserver& observer) {
  GeneralisedBuilding drawn =
      measure(observer, Stage::generalise, [&] { return drawer.draw(result); });
  measure(observer, Stage::write, [&] { drawer.keep_valid(result, drawn); });
  if (is_invalid(drawn)) drawer.repair(result, drawn);
  return drawn;
}

bool has_installation(const Redrawn& level, const std::string& id) {
  const auto& list = level.labelled.installations;
  return std::ranges::find(list, id, &Installation::id) != list.end();
}

}  // namespace

std::string Targets::recipe() const {
  std::string text = fmt::format("scale={}", scale.value_or(0));
  for (const Profile& profile : profiles)
    text += fmt::format(" {}={} edge={}", profile.level, profile.sha256,
                        profile.edge_min_m.value_or(0));
  return text;
}

std::string Targets::text() const {
  if (scale) return fmt::format("1:{}", *scale);
  std::string text;
  for (const Profile& profile : profiles) text += (text.empty() ? "LoD " : ", ") + profile.level;
  return text;
}

Targets at_scale(double denominator) { return {denominator, {}}; }

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
  return logged(
      "generalised", building, [&] { return valid_drawing(drawer, result, options.observer); },
      [](const GeneralisedBuilding& made) {
        return fmt::format("targets={} issues={} repaired={}", made.levels.size(),
                           made.issues.size(), made.repaired.has_value());
      });
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
