#include "cli/view/page_data.h"

#include "interpret/explain.h"
#include "interpret/surfaces.h"
#include "kernel/model/polygon_owners.h"
#include "kernel/model/version.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using Json = nlohmann::ordered_json;

/// A picture needs no more than millimetres.
constexpr double kMillimetres = 1000;

std::vector<std::string> text_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

int last_polygon(const Building& building) {
  int last = -1;
  for (const Polygon& polygon : building.polygons) last = std::max(last, polygon.source);
  return last;
}

}  // namespace

/// Texts that stand in many places, by number.
class TextPool {
 public:
  int number_of(const std::string& text) {
    const auto [found, is_new] = numbers_.try_emplace(text, static_cast<int>(texts_.size()));
    if (is_new) texts_.push_back(text);
    return found->second;
  }
  [[nodiscard]] Json json() const {
    Json list = Json::array();
    for (const std::string& text : texts_) list.push_back(text);
    return list;
  }

 private:
  std::unordered_map<std::string, int> numbers_;
  std::vector<std::string> texts_;
};

struct PageData::State {
  explicit State(const RuleBase& base) : rules(&base) {}

  int row_number(const ExplanationRow& row);
  Json vertices(const Building& building);
  Json polygons(const Building& building, const OnLine& line);
  Json feature(const Explanation& explanation);
  Json features(const OnLine& line);

  const RuleBase* rules;
  /// Of all models together, so that they lie in the same place.
  std::optional<Vec3> origin_m;
  TextPool strings;
  std::unordered_map<std::string, int> row_numbers;
  Json rows = Json::array();
  std::set<std::string> labels;
  Json models = Json::array();
};

int PageData::State::row_number(const ExplanationRow& row) {
  Json cells = {row.indent};
  for (const std::string& cell : row.cells) cells.push_back(strings.number_of(cell));
  cells.push_back(strings.number_of(place_text(row.place)));
  const auto [found, is_new] = row_numbers.try_emplace(cells.dump(), static_cast<int>(rows.size()));
  if (is_new) rows.push_back(std::move(cells));
  return found->second;
}

Json PageData::State::vertices(const Building& building) {
  if (!origin_m) origin_m = building.frame.origin_m;
  Json list = Json::array();
  for (const Vec3& vertex : building.vertices) {
    const Vec3 p = vertex + (building.frame.origin_m - *origin_m);
    for (const double metres : {p.x, p.y, p.z}) list.push_back(std::llround(kMillimetres * metres));
  }
  return list;
}

Json PageData::State::polygons(const Building& building, const OnLine& line) {
  static const Segmentation none;
  const Segmentation& segmentation = line.segmentation ? *line.segmentation : none;
  const auto owners =
      polygon_owners(segmentation, static_cast<std::size_t>(last_polygon(building) + 1));
  std::vector<SurfaceVerdict> verdicts;
  std::vector<std::string> reasons;
  if (line.has_surfaces()) {
    const SurfaceTable table =
        with_parts(line.surfaces, building, segmentation, line.interpretation, *rules);
    verdicts = interpret_surfaces(*rules, table);
    reasons = explain_surfaces(*rules, table);
  }
  Json list = Json::array();
  for (std::size_t i = 0; i < building.polygons.size(); ++i) {
    const Polygon& polygon = building.polygons[i];
    Json why = Json::array();
    if (!reasons.empty())
      for (const std::string& text : text_lines(reasons[i])) why.push_back(strings.number_of(text));
    list.push_back({{"source", polygon.source},
                    {"rings", polygon.rings},
                    {"owners", owners[static_cast<std::size_t>(polygon.source)]},
                    {"surface", verdicts.empty() ? "" : verdicts[i].type},
                    {"why", std::move(why)}});
  }
  return list;
}

Json PageData::State::feature(const Explanation& explanation) {
  Json rules_of_it = Json::array();
  for (const RuleReport& rule : explanation.rules) {
    Json numbers = Json::array();
    for (const ExplanationRow& row : rows_of(rule)) numbers.push_back(row_number(row));
    rules_of_it.push_back(std::move(numbers));
  }
  Json rounds = Json::array();
  for (const RoundReport& round : explanation.rounds)
    rounds.push_back(strings.number_of(round.label.empty() ? "unknown" : round.label));
  const Verdict& verdict = explanation.verdict;
  if (!verdict.label.empty()) labels.insert(verdict.label);
  return {{"id", explanation.feature}, {"label", verdict.label},
          {"rule", verdict.rule},      {"head", headline(explanation)},
          {"rounds", rounds},          {"rules", std::move(rules_of_it)}};
}

Json PageData::State::features(const OnLine& line) {
  Json list = Json::array();
  if (!line.is_done()) return list;
  const auto& [table, graph] = line.description;
  const Explainer explainer(*rules, table, graph, line.interpretation);
  for (int i = 0; i < static_cast<int>(table.rows()); ++i)
    list.push_back(feature(explainer.explain(FeatureId{i})));
  return list;
}

PageData::PageData(const RuleBase& rules) : state_(std::make_unique<State>(rules)) {}
PageData::~PageData() = default;

void PageData::begin_model(const std::string& name) {
  state_->models.push_back({{"name", name}, {"buildings", Json::array()}});
}

void PageData::add(const Building& building, const OnLine& line) {
  Json issues = Json::array();
  for (const Issue& issue : line.issues)
    if (issue.severity != Severity::note)
      issues.push_back(state_->strings.number_of(to_string(issue)));
  Json entry = {{"id", building.id}, {"issues", std::move(issues)}};
  entry["vertices_mm"] = state_->vertices(building);
  entry["features"] = state_->features(line);
  entry["polygons"] = state_->polygons(building, line);
  state_->models.back()["buildings"].push_back(std::move(entry));
}

std::size_t PageData::buildings() const {
  return state_->models.empty() ? 0 : state_->models.back()["buildings"].size();
}

std::string PageData::json() const {
  const Vec3 origin = state_->origin_m.value_or(Vec3{});
  const Json data = {{"oriel", kVersion},
                     {"pack", state_->rules->name() + " " + state_->rules->version()},
                     {"origin_m", {origin.x, origin.y, origin.z}},
                     {"labels", state_->labels},
                     {"strings", state_->strings.json()},
                     {"rows", state_->rows},
                     {"models", state_->models}};
  const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace oriel::cli
