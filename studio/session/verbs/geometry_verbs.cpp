#include "model/version.h"
#include "oriel/explain.h"
#include "oriel/generalise.h"
#include "studio/session/desk.h"
#include "studio/session/geometry_json.h"
#include "studio/session/labels/pack_answer.h"
#include "studio/session/open_buildings.h"
#include "studio/session/reply_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

constexpr std::size_t kAligned = 4;
constexpr std::int64_t kMostShort = std::numeric_limits<std::uint16_t>::max();

using PointMm = std::array<std::int64_t, 3>;

void append_number(std::uint32_t number, std::size_t bytes, std::string& text) {
  for (std::size_t i = 0; i < bytes; ++i) text.push_back(static_cast<char>(number >> (8 * i)));
}

void fill_up(char filling, std::string& text) {
  text.resize((text.size() + kAligned - 1) / kAligned * kAligned, filling);
}

void append_list(std::span<const std::uint32_t> numbers, bool is_short, std::string& text) {
  for (const std::uint32_t number : numbers) append_number(number, is_short ? 2 : 4, text);
  fill_up('\0', text);
}

/// The lists of a building.
struct FlatBuilding {
  PointMm base_mm{};
  bool is_short = true;
  std::vector<std::uint32_t> vertices, ring_ends, corner_ends, corners, owner_ends, owners;

  [[nodiscard]] bool are_few() const {
    const std::size_t most = std::max({vertices.size(), corners.size(), owners.size()});
    return std::cmp_less_equal(most, kMostShort);
  }
};

void flatten_vertices(const OpenBuilding& open, const Vec3& origin_m, FlatBuilding& flat) {
  std::vector<PointMm> points;
  points.reserve(open.building->vertices.size());
  const Vec3 shift_m = open.building->frame.origin_m - origin_m;
  for (const Vec3& vertex : open.building->vertices) {
    const Vec3 p = vertex + shift_m;
    points.push_back({whole_millimetres(p.x), whole_millimetres(p.y), whole_millimetres(p.z)});
  }
  for (std::size_t axis = 0; axis < 3 && !points.empty(); ++axis) {
    const auto along = [axis](const PointMm& p) { return p[axis]; };
    const auto [least, most] = std::ranges::minmax(points, {}, along);
    flat.base_mm[axis] = least[axis];
    flat.is_short = flat.is_short && most[axis] - least[axis] <= kMostShort;
  }
  for (const PointMm& p : points)
    for (std::size_t axis = 0; axis < 3; ++axis)
      flat.vertices.push_back(static_cast<std::uint32_t>(p[axis] - flat.base_mm[axis]));
}

void flatten_polygons(const OpenBuilding& open, FlatBuilding& flat) {
  for (const Polygon& polygon : open.building->polygons) {
    for (const auto& ring : polygon.rings) {
      for (const auto vertex : ring) flat.corners.push_back(static_cast<std::uint32_t>(vertex));
      flat.corner_ends.push_back(static_cast<std::uint32_t>(flat.corners.size()));
    }
    flat.ring_ends.push_back(static_cast<std::uint32_t>(flat.corner_ends.size()));
    for (const int owner : open.owners[static_cast<std::size_t>(polygon.source)])
      flat.owners.push_back(static_cast<std::uint32_t>(owner));
    flat.owner_ends.push_back(static_cast<std::uint32_t>(flat.owners.size()));
  }
}

StudioJson storeys_json(const OpenBuilding& open, const Vec3& origin_m) {
  StudioJson list = StudioJson::array();
  for (const double floor_m : storey_floors(*open.building, open.segmented))
    list.push_back(whole_millimetres(floor_m + open.building->frame.origin_m.z - origin_m.z));
  return list;
}

}  // namespace

std::string building_bytes(const std::vector<NumberedBuilding>& buildings) {
  StudioJson entries = StudioJson::array();
  std::string lists;
  for (const auto& [number, open, origin_m] : buildings) {
    FlatBuilding flat;
    flatten_vertices(*open, origin_m, flat);
    flatten_polygons(*open, flat);
    entries.push_back({{"number", number},
                       {"base_mm", flat.base_mm},
                       {"is_short", flat.is_short},
                       {"are_few", flat.are_few()},
                       {"vertices", flat.vertices.size() / 3},
                       {"polygons", flat.ring_ends.size()},
                       {"rings", flat.corner_ends.size()},
                       {"corners", flat.corners.size()},
                       {"owners", flat.owners.size()},
                       {"storeys_mm", storeys_json(*open, origin_m)}});
    append_list(flat.vertices, flat.is_short, lists);
    for (const auto* list :
         {&flat.ring_ends, &flat.corner_ends, &flat.corners, &flat.owner_ends, &flat.owners})
      append_list(*list, flat.are_few(), lists);
  }
  std::string head = dump({{"buildings", std::move(entries)}});
  fill_up(' ', head);
  std::string bytes;
  bytes.reserve(kAligned + head.size() + lists.size());
  append_number(static_cast<std::uint32_t>(head.size()), kAligned, bytes);
  return bytes.append(head).append(lists);
}

namespace {

/// What the slider of scales stops at: denominators.
constexpr int kScales[] = {1, 500, 1000, 2500, 5000, 10000, 25000};

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

}  // namespace

StudioJson building_entry(const BuildingOfFile& read, const OpenBuilding* open,
                          const Standing& standing) {
  const auto& [origin_m, away_m, is_moved] = standing;
  const Box box = box_of(*read.building);
  const bool is_flat = box.is_empty();
  StudioJson entry{{"id", read.building->id},
                   {"file", read.file},
                   {"is_loaded", open != nullptr},
                   {"features", open != nullptr ? open->features.size() : 0},
                   {"at_m", point_json(is_flat ? Vec3{} : box.min - origin_m)},
                   {"size_m", point_json(is_flat ? Vec3{} : box.max - box.min)},
                   {"issues", StudioJson::array()},
                   {"is_open", open != nullptr && open->segmented.is_open()}};
  if (away_m > 0) entry["away_m"] = std::round(away_m);
  if (is_moved) entry["is_moved"] = true;
  if (open != nullptr)
    for (const Issue& issue : open->segmented.issues)
      if (issue.severity != Severity::note) entry["issues"].push_back(issue_json(issue));
  return entry;
}

StudioJson features_json(const OpenBuilding& open, const Interpretation* interpretation) {
  StudioJson list = StudioJson::array();
  const PipelineResult& result = open.segmented;
  if (!result.is_done()) return list;
  const auto names = feature_names(*result.segmentation, result.description.table, interpretation);
  for (std::size_t i = 0; i < open.features.size(); ++i) {
    const Feature& feature = result.segmentation->features[i];
    list.push_back({{"id", open.features[i].id},
                    {"name", names[i]},
                    {"kind", kind_word(feature.sense)},
                    {"parent", feature.parent.value}});
  }
  return list;
}

StudioJson surfaces_json(const std::vector<SurfaceExplanation>& surfaces) {
  StudioJson types = StudioJson::array(), why = StudioJson::array();
  for (const SurfaceExplanation& surface : surfaces) {
    types.push_back(surface.type);
    why.push_back(surface.reason);
  }
  return {{"types", std::move(types)}, {"why", std::move(why)}};
}

StudioJson answer_state(Desk& desk, const RequestBody& /*body*/) {
  const LoadingState loading = desk.buildings.loading();
  const auto read = desk.buildings.read();
  const BuildingList list = desk.buildings.list();
  const auto standings = desk.buildings.standings();
  StudioJson buildings = StudioJson::array();
  for (std::size_t i = 0; i < std::min(read.size(), standings->size()); ++i)
    buildings.push_back(
        building_entry(read[i], i < list.size() ? list[i].get() : nullptr, (*standings)[i]));
  std::vector<Issue> issues = desk.buildings.issues();
  issues.insert(issues.end(), desk.corrections.issues().begin(), desk.corrections.issues().end());
  StudioJson faults = StudioJson::array();
  for (const Issue& issue : issues)
    faults.emplace_back(issue_json(issue))["file"] = issue.place.file;
  return {{"program", fmt::format("oriel {}", kVersion)},
          {"pack", desk.file.state()},
          {"buildings", std::move(buildings)},
          {"has_truth", desk.buildings.has_truth() || !desk.corrections.list().empty()},
          {"corrections", desk.corrections.path()},
          {"scales", kScales},
          {"lods", levels_of_detail()},
          {"issues", std::move(faults)},
          {"offers_samples", desk.buildings.offers_samples()},
          {"loading", {{"done", loading.done}, {"all", loading.all}}}};
}

std::string geometry_bytes(Desk& desk, const RequestBody& body) {
  const auto standings = desk.buildings.standings();
  const BuildingList list = desk.buildings.list();
  std::vector<NumberedBuilding> loaded;
  for (const std::size_t number : body.numbers("buildings", list.size(), "building"))
    if (list[number]) loaded.push_back({number, list[number].get(), (*standings)[number].origin_m});
  return building_bytes(loaded);
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
    const Interpretation* said = features != nullptr ? &features->interpretation : nullptr;
    buildings.push_back({{"number", number}, {"features", features_json(*list[number], said)}});
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
  return surfaces_json(explain_surfaces(*open.building, result, asked.all->rules));
}

}  // namespace oriel::studio
