#include "kernel/model/version.h"
#include "oriel/explain.h"
#include "oriel/generalise.h"
#include "studio/session/desk.h"
#include "studio/session/geometry_json.h"
#include "studio/session/labels/pack_answer.h"
#include "studio/session/plain_sentence.h"
#include "studio/session/verbs/building_bytes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

/// What the slider of scales stops at: denominators.
constexpr int kScales[] = {1, 500, 1000, 2500, 5000, 10000, 25000};

Box box_of(const Building& building) {
  Box box;
  for (const Vec3& vertex : building.vertices) box.grow(vertex + building.frame.origin_m);
  return box;
}

/// The levels of detail that the profile "lod" has, from fine to coarse.
const std::vector<std::string>& levels_of_detail() {
  static const std::vector<std::string> levels = [] {
    std::vector<std::string> known;
    for (int whole = 3; whole >= 0; --whole)
      for (int tenth = 9; tenth >= 0; --tenth) {
        std::string level = fmt::format("{}.{}", whole, tenth);
        if (load_profile_file("lod:" + level).value) known.push_back(std::move(level));
      }
    return known;
  }();
  return levels;
}

StudioJson building_entry(const BuildingOfFile& read, const OpenBuilding* open,
                          const Vec3& origin_m) {
  const Box box = box_of(*read.building);
  const bool is_flat = box.is_empty();
  StudioJson entry{{"id", read.building->id},
                   {"file", read.file},
                   {"is_loaded", open != nullptr},
                   {"features", open != nullptr ? open->features.size() : 0},
                   {"at_m", point_json(is_flat ? Vec3{} : box.min - origin_m)},
                   {"size_m", point_json(is_flat ? Vec3{} : box.max - box.min)},
                   {"issues", StudioJson::array()},
                   {"is_open", open != nullptr && open->segmented.is_open}};
  if (open != nullptr)
    for (const Issue& issue : open->segmented.issues)
      if (issue.severity != Severity::note) entry["issues"].push_back(issue_json(issue));
  return entry;
}

StudioJson features_json(const OpenBuilding& open, const LabelledFeatures* labelled) {
  StudioJson list = StudioJson::array();
  const PipelineResult& result = open.segmented;
  if (!result.is_done()) return list;
  const auto names = feature_names(*result.segmentation, result.description.table,
                                   labelled != nullptr ? &labelled->interpretation : nullptr);
  for (std::size_t i = 0; i < open.features.size(); ++i) {
    const Feature& feature = result.segmentation->features[i];
    list.push_back({{"id", open.features[i].id},
                    {"name", names[i]},
                    {"kind", kind_word(feature.sense)},
                    {"parent", feature.parent.value}});
  }
  return list;
}

}  // namespace

StudioJson answer_state(Desk& desk, const RequestBody& /*body*/) {
  const LoadingState loading = desk.buildings.loading();
  const auto read = desk.buildings.read();
  const BuildingList list = desk.buildings.list();
  const Vec3 origin_m = desk.buildings.origin_m();
  StudioJson buildings = StudioJson::array();
  for (std::size_t i = 0; i < read.size(); ++i)
    buildings.push_back(
        building_entry(read[i], i < list.size() ? list[i].get() : nullptr, origin_m));
  std::vector<Issue> issues = desk.buildings.issues();
  issues.insert(issues.end(), desk.corrections.issues().begin(), desk.corrections.issues().end());
  return {{"program", fmt::format("oriel {}", kVersion)},
          {"pack", desk.file.state()},
          {"origin_m", point_json(origin_m)},
          {"buildings", std::move(buildings)},
          {"has_truth", desk.buildings.has_truth() || !desk.corrections.list().empty()},
          {"corrections", desk.corrections.path()},
          {"scales", kScales},
          {"lods", levels_of_detail()},
          {"issues", issues_json(issues)},
          {"loading", {{"done", loading.done}, {"all", loading.all}}}};
}

std::string geometry_bytes(Desk& desk, const RequestBody& body) {
  const BuildingList list = desk.buildings.list();
  std::vector<NumberedBuilding> loaded;
  for (const std::size_t number : body.numbers("buildings", list.size(), "building"))
    if (list[number]) loaded.push_back({number, list[number].get()});
  return building_bytes(loaded, desk.buildings.origin_m());
}

StudioJson answer_features(Desk& desk, const RequestBody& body) {
  const BuildingList list = desk.buildings.list();
  const auto labelled = desk.runner.current();
  StudioJson buildings = StudioJson::array();
  for (const std::size_t number : body.numbers("buildings", list.size(), "building")) {
    if (!list[number]) continue;
    const LabelledFeatures* features = labelled && number < labelled->buildings.size()
                                           ? labelled->buildings[number].get()
                                           : nullptr;
    buildings.push_back({{"number", number}, {"features", features_json(*list[number], features)}});
  }
  return {{"buildings", std::move(buildings)}};
}

AskedBuilding asked_building(Desk& desk, const RequestBody& body) {
  const BuildingList list = desk.buildings.list();
  AskedBuilding asked;
  asked.number = body.number("building", list.size(), "building");
  if (!list[asked.number]) throw RefusedRequest(409, "the building is not loaded yet");
  asked.all = desk.runner.need_current();
  asked.labelled = asked.all->buildings.at(asked.number);
  return asked;
}

FeatureId asked_feature(const RequestBody& body, const OpenBuilding& building) {
  return FeatureId{static_cast<int>(body.number("feature", building.features.size(), "feature"))};
}

StudioJson answer_surfaces(Desk& desk, const RequestBody& body) {
  const AskedBuilding asked = asked_building(desk, body);
  const OpenBuilding& open = *asked.labelled->building;
  LabelOptions options = desk.options.label;
  options.corrections = nullptr;
  options.has_output = false;
  options.measures_surfaces = true;
  const PipelineResult result = label(*open.building, open.segmented, asked.all->rules, options);
  StudioJson types = StudioJson::array(), why = StudioJson::array();
  for (const SurfaceExplanation& surface :
       explain_surfaces(*open.building, result, asked.all->rules)) {
    types.push_back(surface.type);
    why.push_back(surface.reason);
  }
  return {{"types", std::move(types)}, {"why", std::move(why)}};
}

}  // namespace oriel::studio
