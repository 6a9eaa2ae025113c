#include "oriel/corrections.h"
#include "oriel/score.h"
#include "studio/session/desk.h"
#include "studio/session/geometry_json.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace oriel::studio {

namespace {

/// The class of a correction in the request: nothing is withdrawal, "unknown" an empty label.
std::optional<std::string> asked_class(const RequestBody& body) {
  if (body.is_null("class")) return std::nullopt;
  const std::string label = body.text("class");
  if (label.empty()) throw RefusedRequest(400, "'class' is empty; say a class, unknown, or null");
  return label == "unknown" ? std::string() : label;
}

}  // namespace

StudioJson answer_truth(Desk& desk, const RequestBody& body) {
  const BuildingList list = desk.buildings.list();
  const auto standings = desk.buildings.standings();
  const auto truth = desk.corrections.truth();
  StudioJson objects = StudioJson::array();
  for (const std::size_t number : body.numbers("buildings", list.size(), "building")) {
    if (!list[number]) continue;
    const auto of_building = truth->of(*list[number]);
    if (!of_building) continue;
    for (const ExpectedObject& object : *of_building) {
      if (is_left_out(object)) continue;
      objects.push_back({{"building", number},
                         {"class", object.label},
                         {"id", object.id},
                         {"box_mm", box_mm_json(object.box, (*standings)[number].origin_m)}});
    }
  }
  return {{"objects", std::move(objects)}};
}

StudioJson answer_correct(Desk& desk, const RequestBody& body) {
  const BuildingList list = desk.buildings.list();
  const std::size_t number = body.number("building", list.size(), "building");
  if (!list[number]) throw RefusedRequest(409, "the building is not loaded yet");
  const OpenBuilding& open = *list[number];
  const PlacedFeature& feature = open.features[asked_feature(body, open).index()];
  const auto label = asked_class(body);
  Correction correction;
  correction.building = open.building->id;
  correction.feature = feature.id;
  // Ids change with the model; a point in its box finds the feature then.
  correction.point = 0.5 * (feature.box.min + feature.box.max);
  correction.label = label.value_or("");
  correction.by = body.optional_text("by").value_or("");
  correction.why = body.optional_text("why").value_or("");
  return {{"count", desk.corrections.correct(std::move(correction), !label)}};
}

StudioJson answer_corrections(Desk& desk, const RequestBody& /*body*/) {
  const BuildingList buildings = desk.buildings.list();
  std::map<std::string, std::size_t> numbers;
  for (std::size_t i = 0; i < buildings.size(); ++i)
    if (buildings[i]) numbers.emplace(buildings[i]->building->id, i);
  StudioJson list = StudioJson::array();
  for (const Correction& correction : desk.corrections.list()) {
    int building = -1, feature = -1;
    if (const auto found = numbers.find(correction.building); found != numbers.end()) {
      building = static_cast<int>(found->second);
      std::vector<Issue> issues;
      const auto placed =
          Corrections({correction})
              .find(correction.building, buildings[found->second]->features, issues);
      if (!placed.empty()) feature = static_cast<int>(placed.front().feature);
    }
    list.push_back({{"building", building},
                    {"feature", feature},
                    {"building_id", correction.building},
                    {"feature_id", correction.feature},
                    {"class", correction.label.empty() ? "unknown" : correction.label},
                    {"by", correction.by},
                    {"why", correction.why}});
  }
  return {{"path", desk.corrections.path()}, {"list", std::move(list)}};
}

}  // namespace oriel::studio
