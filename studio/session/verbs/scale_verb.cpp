#include "oriel/generalise.h"
#include "studio/session/desk.h"
#include "studio/session/geometry_json.h"
#include "studio/session/labels/pack_answer.h"
#include "studio/session/work_log.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

/// What is asked for: a scale or a level of detail.
Targets asked_targets(const RequestBody& body) {
  if (const auto scale = body.optional_real("scale")) {
    if (!(*scale >= 1) || !std::isfinite(*scale))
      throw RefusedRequest(400, "'scale' must be at least 1, the N of 1:N", Code::E125);
    return at_scale(*scale);
  }
  const auto level = body.optional_text("lod");
  if (!level) throw RefusedRequest(400, "'scale' or 'lod' is missing from the request");
  auto profile = load_profile_file("lod:" + *level);
  if (!profile.value)
    throw RefusedRequest(400, fmt::format("there is no level of detail '{}' to draw", *level),
                         Code::R275);
  Targets targets;
  targets.profiles.push_back(std::move(*profile.value));
  return targets;
}

/// Writes a building that was redrawn.
class RedrawnWriter {
 public:
  RedrawnWriter(const OpenBuilding& open, const Vec3& origin_m) : open_(open), origin_m_(origin_m) {
    for (std::size_t i = 0; i < open.features.size(); ++i)
      feature_by_id_.emplace(open.features[i].id, static_cast<int>(i));
  }

  void write(const GeneralisedBuilding& made, StudioJson& answer) {
    answer["vertices_mm"] = StudioJson::array();
    answer["polygons"] = StudioJson::array();
    if (!made.levels.empty()) write_level(made.levels.front().labelled, answer);
    answer["outcomes"] = outcomes(made);
    answer["issues"] = StudioJson::array();
    for (const Issue& issue : made.issues)
      if (issue.severity != Severity::note) answer["issues"].push_back(issue_json(issue));
    answer["is_valid"] =
        !made.levels.empty() && std::ranges::none_of(made.issues, [](const Issue& issue) {
          return issue.place.feature.empty() &&
                 (issue.code == Code::G410 || issue.code == Code::G413);
        });
  }

 private:
  [[nodiscard]] int feature_of(const std::string& id) const {
    const auto found = feature_by_id_.find(id);
    return found == feature_by_id_.end() ? -1 : found->second;
  }

  /// By polygon what it is of: surfaces that are features, and installations over them.
  void write_level(const LabelledBuilding& level, StudioJson& answer) {
    const std::size_t count = level.surface_of_polygon.size();
    std::vector<int> features(count, -1), surfaces = level.surface_of_polygon;
    for (std::size_t i = 0; i < count; ++i)
      if (surfaces[i] >= 0)
        features[i] = feature_of(level.surfaces[static_cast<std::size_t>(surfaces[i])].label->id);
    for (const Installation& installation : level.installations)
      for (std::size_t i = 0; i < installation.polygons.size(); ++i) {
        const auto polygon = static_cast<std::size_t>(installation.polygons[i]);
        if (polygon >= count) continue;
        features[polygon] = feature_of(installation.label->id);
        surfaces[polygon] = installation.surfaces[i];
      }
    const auto type_of = [&](std::size_t polygon) {
      return surfaces[polygon] < 0
                 ? std::string()
                 : level.surfaces[static_cast<std::size_t>(surfaces[polygon])].type;
    };
    const auto add = [&](std::size_t polygon, StudioJson rings) {
      answer["polygons"].push_back({{"source", polygon},
                                    {"rings", std::move(rings)},
                                    {"feature", polygon < count ? features[polygon] : -1},
                                    {"surface", polygon < count ? type_of(polygon) : ""}});
    };
    const Building& building = *open_.building;
    if (!level.geometry) {
      answer["vertices_mm"] = vertices_mm_json(building.vertices, building.frame, origin_m_);
      for (const Polygon& polygon : building.polygons)
        add(static_cast<std::size_t>(polygon.source), polygon.rings);
      return;
    }
    std::vector<Vec3> points;
    for (const Vertex& vertex : level.geometry->vertices) points.push_back(vertex.point);
    answer["vertices_mm"] = vertices_mm_json(points, building.frame, origin_m_);
    for (std::size_t i = 0; i < level.geometry->facets.size(); ++i)
      add(i, level.geometry->facets[i].loops);
  }

  static std::string sentence_of(const FeatureOutcome& outcome) {
    const std::string asked = outcome.rule.empty() ? "" : ", as " + outcome.rule + " asks";
    if (outcome.outcome == "omitted") return "left out" + asked;
    if (outcome.outcome == "changed")
      return fmt::format("changed ({}){}{}", outcome.operation, asked,
                         outcome.reason.empty() ? "" : ": " + outcome.reason);
    if (outcome.outcome == "went along")
      return outcome.reason.empty() ? outcome.outcome : outcome.reason + asked;
    if (outcome.outcome == "refused")
      return fmt::format("stays as it is, though {} asks for {}: {}",
                         outcome.rule.empty() ? "the pack" : outcome.rule, outcome.operation,
                         outcome.reason);
    return outcome.reason.empty() ? "" : "stays: " + outcome.reason;
  }

  /// Of what was asked for; what simply stays is left out.
  [[nodiscard]] StudioJson outcomes(const GeneralisedBuilding& made) const {
    StudioJson list = StudioJson::array();
    if (made.reports.empty()) return list;
    for (const FeatureOutcome& outcome : made.reports.front().changes) {
      std::string sentence = sentence_of(outcome);
      if (sentence.empty()) continue;
      list.push_back({{"feature", feature_of(outcome.feature)},
                      {"operator", outcome.operation},
                      {"outcome", outcome.outcome},
                      {"rule", outcome.rule},
                      {"sentence", std::move(sentence)}});
    }
    return list;
  }

  const OpenBuilding& open_;
  Vec3 origin_m_;
  std::map<std::string, int> feature_by_id_;
};

/// Draws the building; null if it was given up.
ScaleCache::Answer drawn(Desk& desk, const AskedBuilding& asked, const Targets& targets,
                         const IsGivenUp& is_given_up) {
  const OpenBuilding& open = *asked.labelled->building;
  DrawingProgress::DrawingAtWork drawing(desk.drawing, asked.number, targets.text());
  GeneraliseOptions options;
  static_cast<LabelOptions&>(options) = desk.options.label;
  options.corrections = nullptr;
  options.has_output = false;
  options.reports_changes = true;
  options.is_given_up = [&](Stage stage) {
    drawing.pass(stage);
    return is_given_up();
  };
  if (options.is_given_up(Stage::interpret)) return nullptr;
  const AtWork at_work(desk.options.work_log, WorkLog::Kind::building, asked.number);
  const RuleBase& rules = asked.all->rules;
  const PipelineResult result = label(*open.building, open.segmented, rules, options);
  if (options.is_given_up(Stage::generalise)) return nullptr;
  const GeneralisedBuilding made =
      generalise(*open.document, *open.building, result, rules, targets, options);
  if (made.is_given_up) return nullptr;
  StudioJson answer = StudioJson::object();
  const Vec3 origin_m = (*desk.buildings.standings())[asked.number].origin_m;
  RedrawnWriter(open, origin_m).write(made, answer);
  answer["note"] = asked.all->buildings.size() > 1
                       ? "this building is drawn alone; the other buildings are not looked at and "
                         "stay as they are"
                       : "";
  return std::make_shared<const StudioJson>(std::move(answer));
}

}  // namespace

StudioJson answer_scale(Desk& desk, const RequestBody& body) {
  if (body.flag("progress")) return desk.drawing.json();
  if (body.flag("stop")) {
    desk.drawings.give_up_all();
    return desk.drawing.json();
  }
  const Targets targets = asked_targets(body);
  const AskedBuilding asked = asked_building(desk, body);
  const std::string key =
      fmt::format("{} {} {}", asked.number, asked.all->rules.sha256(), targets.recipe());
  const auto is_given_up = desk.drawings.begin(key);
  // Null may be an older request's for the same, given up in between: once more.
  while (!is_given_up())
    if (const auto answer =
            desk.scales.get(key, [&] { return drawn(desk, asked, targets, is_given_up); }))
      return *answer;
  refuse_superseded("another drawing was asked for, or none");
}

}  // namespace oriel::studio
