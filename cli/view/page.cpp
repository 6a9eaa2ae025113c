#include "cli/view/page.h"

#include "model/polygon_owners.h"
#include "model/version.h"
#include "oriel/explain.h"
#include "oriel/rules.h"
#include "studio/server/page_files.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

/// A picture needs no more than millimetres.
constexpr double kMillimetres = 1000;

/// Of a relation that leads to more features the page says nothing: it would draw no line of it.
constexpr std::size_t kMostRelated = 24;

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
  [[nodiscard]] ordered_json json() const {
    ordered_json list = ordered_json::array();
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
  ordered_json vertices(const Building& building);
  ordered_json polygons(const Building& building, const PipelineResult& line);
  ordered_json relations_of(const FeatureRelations& relations, FeatureId feature);
  ordered_json feature(const PipelineResult& line, const Explanation& explanation,
                       const FeatureRelations& relations, FeatureId feature);
  ordered_json features(const PipelineResult& line);
  ordered_json storeys(const Building& building, const PipelineResult& line);
  ordered_json polygons(const Building& building, const CarriedLabels& carried);
  ordered_json features(const std::string& building, const CarriedLabels& carried);
  void add(const Building& building, const PipelineResult& line, ordered_json features,
           ordered_json polygons);

  const RuleBase* rules;
  /// Of all models together, so that they lie in the same place.
  std::optional<Vec3> origin_m;
  TextPool strings;
  std::unordered_map<std::string, int> row_numbers;
  ordered_json rows = ordered_json::array();
  std::set<std::string> labels;
  ordered_json models = ordered_json::array();
  /// Features of the first model, by building, id and rule.
  std::map<std::tuple<std::string, std::string, std::string>, ordered_json> rules_before;
};

int PageData::State::row_number(const ExplanationRow& row) {
  ordered_json cells = {row.indent};
  for (const std::string& cell : row.cells) cells.push_back(strings.number_of(cell));
  cells.push_back(strings.number_of(place_text(row.place)));
  const auto [found, is_new] = row_numbers.try_emplace(cells.dump(), static_cast<int>(rows.size()));
  if (is_new) rows.push_back(std::move(cells));
  return found->second;
}

ordered_json PageData::State::vertices(const Building& building) {
  if (!origin_m) origin_m = building.frame.origin_m;
  ordered_json list = ordered_json::array();
  for (const Vec3& vertex : building.vertices) {
    const Vec3 p = vertex + (building.frame.origin_m - *origin_m);
    for (const double metres : {p.x, p.y, p.z}) list.push_back(std::llround(kMillimetres * metres));
  }
  return list;
}

ordered_json PageData::State::polygons(const Building& building, const PipelineResult& line) {
  static const Segmentation none;
  const Segmentation& segmentation = line.segmentation ? *line.segmentation : none;
  const auto owners =
      polygon_owners(segmentation, static_cast<std::size_t>(last_polygon(building) + 1));
  const std::vector<SurfaceExplanation> surfaces = explain_surfaces(building, line, *rules);
  ordered_json list = ordered_json::array();
  for (std::size_t i = 0; i < building.polygons.size(); ++i) {
    const Polygon& polygon = building.polygons[i];
    ordered_json why = ordered_json::array();
    if (!surfaces.empty())
      for (const std::string& text : text_lines(surfaces[i].reason))
        why.push_back(strings.number_of(text));
    list.push_back({{"source", polygon.source},
                    {"rings", polygon.rings},
                    {"owners", owners[static_cast<std::size_t>(polygon.source)]},
                    {"surface", surfaces.empty() ? "" : surfaces[i].type},
                    {"why", std::move(why)}});
  }
  return list;
}

ordered_json PageData::State::relations_of(const FeatureRelations& relations, FeatureId feature) {
  ordered_json list = ordered_json::array();
  for (const RelatedFeatures& related : relations.of(feature)) {
    if (related.others.size() > kMostRelated) continue;
    ordered_json numbers = ordered_json::array();
    for (const FeatureId other : related.others) numbers.push_back(other.value);
    list.push_back({strings.number_of(related.relation), std::move(numbers)});
  }
  return list;
}

ordered_json PageData::State::feature(const PipelineResult& line, const Explanation& explanation,
                                      const FeatureRelations& relations, FeatureId feature) {
  ordered_json rules_of_it = ordered_json::array();
  for (const RuleReport& rule : explanation.rules) {
    ordered_json numbers = ordered_json::array();
    for (const ExplanationRow& row : rows_of(rule)) numbers.push_back(row_number(row));
    rules_of_it.push_back(std::move(numbers));
  }
  const Verdict& verdict = explanation.verdict;
  if (!verdict.label.empty()) labels.insert(verdict.label);
  const Feature& what = line.segmentation->features[feature.index()];
  return {{"id", explanation.feature},
          {"name", explanation.name},
          {"kind", kind_word(what.sense)},
          {"parent", what.parent.value},
          {"label", verdict.label},
          {"rule", verdict.rule},
          {"sentence", plain_sentence(line, line.interpretation, feature)},
          {"head", headline(explanation)},
          {"rules", std::move(rules_of_it)},
          {"relations", relations_of(relations, feature)}};
}

ordered_json PageData::State::features(const PipelineResult& line) {
  ordered_json list = ordered_json::array();
  const auto explanations = explain_features(line, *rules);
  if (explanations.empty()) return list;
  const FeatureRelations relations(*rules, line.description.table, line.description.graph);
  for (const Explanation& explanation : explanations)
    list.push_back(feature(line, explanation, relations, FeatureId{static_cast<int>(list.size())}));
  return list;
}

ordered_json PageData::State::storeys(const Building& building, const PipelineResult& line) {
  ordered_json list = ordered_json::array();
  if (!origin_m) origin_m = building.frame.origin_m;
  for (const double floor_m : storey_floors(building, line))
    list.push_back(
        std::llround(kMillimetres * (floor_m + building.frame.origin_m.z - origin_m->z)));
  return list;
}

/// The owners of a polygon stand in the order of their sizes, the smallest first.
ordered_json PageData::State::polygons(const Building& building, const CarriedLabels& carried) {
  std::vector<std::vector<int>> owners(carried.surfaces.size());
  for (std::size_t f = 0; f < carried.features.size(); ++f)
    for (const int polygon : carried.features[f].polygons)
      owners[static_cast<std::size_t>(polygon)].push_back(static_cast<int>(f));
  for (auto& features : owners)
    std::ranges::stable_sort(features, {}, [&](int f) {
      return carried.features[static_cast<std::size_t>(f)].polygons.size();
    });
  ordered_json list = ordered_json::array();
  for (const Polygon& polygon : building.polygons) {
    const auto source = static_cast<std::size_t>(polygon.source);
    const CarriedSurface& surface = carried.surfaces.at(source);
    ordered_json why = ordered_json::array();
    why.push_back(strings.number_of(surface.type.empty() ? "the file says nothing of it"
                                                         : surface.type + ", as the file says"));
    if (!surface.why.empty()) why.push_back(strings.number_of(surface.why));
    list.push_back({{"source", polygon.source},
                    {"rings", polygon.rings},
                    {"owners", owners[source]},
                    {"surface", surface.type},
                    {"why", std::move(why)}});
  }
  return list;
}

ordered_json PageData::State::features(const std::string& building, const CarriedLabels& carried) {
  ordered_json list = ordered_json::array();
  for (const CarriedFeature& said : carried.features) {
    const auto before = rules_before.find({building, said.id, said.rule});
    labels.insert(said.label);
    list.push_back(
        {{"id", said.id},
         {"name", said.name},
         {"kind", ""},
         {"parent", -1},
         {"label", said.label},
         {"rule", said.rule},
         {"sentence", said.label + ": so it is called in the file"},
         {"head", fmt::format("{} -> {} {:.2f} by {}, as the file says", said.id, said.label,
                              said.score, said.rule)},
         {"rules", before == rules_before.end() ? ordered_json::array() : before->second},
         {"relations", ordered_json::array()}});
  }
  return list;
}

PageData::PageData(const RuleBase& rules) : state_(std::make_unique<State>(rules)) {}
PageData::~PageData() = default;

void PageData::begin_model(const std::string& name) {
  state_->models.push_back({{"name", name}, {"buildings", ordered_json::array()}});
}

void PageData::State::add(const Building& building, const PipelineResult& line,
                          ordered_json features, ordered_json polygons) {
  ordered_json issues = ordered_json::array();
  for (const Issue& issue : line.issues)
    if (issue.severity != Severity::note)
      issues.push_back({{"code", to_string(issue.code)},
                        {"severity", to_string(issue.severity)},
                        {"sentence", issue.sentence}});
  ordered_json entry = {{"id", building.id}, {"issues", std::move(issues)}};
  entry["vertices_mm"] = vertices(building);
  entry["storeys_mm"] = storeys(building, line);
  entry["features"] = std::move(features);
  entry["polygons"] = std::move(polygons);
  models.back()["buildings"].push_back(std::move(entry));
}

void PageData::add(const Building& building, const PipelineResult& line) {
  ordered_json features = state_->features(line);
  if (state_->models.size() == 1)
    for (const ordered_json& feature : features)
      state_->rules_before.emplace(std::tuple(building.id, feature["id"], feature["rule"]),
                                   feature["rules"]);
  ordered_json polygons = state_->polygons(building, line);
  state_->add(building, line, std::move(features), std::move(polygons));
}

void PageData::add(const Building& building, const PipelineResult& line,
                   const CarriedLabels& carried) {
  ordered_json features = state_->features(building.id, carried);
  ordered_json polygons = state_->polygons(building, carried);
  state_->add(building, line, std::move(features), std::move(polygons));
}

std::size_t PageData::buildings() const {
  return state_->models.empty() ? 0 : state_->models.back()["buildings"].size();
}

std::string PageData::json() const {
  const Vec3 origin = state_->origin_m.value_or(Vec3{});
  const ordered_json data = {{"oriel", kVersion},
                             {"pack", state_->rules->name() + " " + state_->rules->version()},
                             {"origin_m", {origin.x, origin.y, origin.z}},
                             {"labels", state_->labels},
                             {"strings", state_->strings.json()},
                             {"rows", state_->rows},
                             {"models", state_->models}};
  const std::string text = data.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
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

std::string page_of(const std::string& data) {
  static constexpr std::string_view kMark = "{{data}}";
  const std::string_view page = studio::page_file("view.html");
  const std::size_t at = page.find(kMark);
  std::string whole(page.substr(0, at));
  return whole.append(data).append(page.substr(at + kMark.size()));
}

}  // namespace oriel::cli
