#include "studio/session/recording.h"

#include "model/version.h"
#include "oriel/explain.h"
#include "studio/session/geometry_json.h"
#include "studio/session/labels/pack_answer.h"
#include "studio/session/reply_parts.h"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::studio {

namespace {

/// The most features to which a relation is shown: the page would draw no lines to more.
constexpr std::size_t kMostRelated = 24;

std::string base64(const std::string& bytes) {
  using namespace boost::archive::iterators;
  using Digits = base64_from_binary<transform_width<const char*, 6, 8>>;
  std::string text(Digits(bytes.data()), Digits(bytes.data() + bytes.size()));
  return text.append((3 - bytes.size() % 3) % 3, '=');
}

/// Values of JSON, each once and by number: texts of one line and numbers as they are, lists as
/// [-1, values…], texts of several lines as [-2, lines…], objects as [keys, values…].
class ValuePool {
 public:
  std::size_t number_of(const StudioJson& value) {
    if (value.is_string()) return number_of_text(value.get<std::string>());
    if (!value.is_structured()) return values_.number_of(dump(value));
    std::vector<std::string> entry{"-1"};
    if (value.is_object()) {
      StudioJson keys = StudioJson::array();
      for (const auto& [key, part] : value.items()) keys.push_back(key);
      entry[0] = std::to_string(keys_.number_of(dump(keys)));
    }
    for (const StudioJson& part : value) entry.push_back(std::to_string(number_of(part)));
    return values_.number_of(fmt::format("[{}]", fmt::join(entry, ",")));
  }
  std::size_t number_of_text(const std::string& text) {
    if (text.find('\n') == std::string::npos) return values_.number_of(dump(text));
    std::string entry = "[-2";
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
      end = text.find('\n', begin);
      entry += "," + std::to_string(values_.number_of(dump(text.substr(begin, end - begin))));
    }
    return values_.number_of(entry + "]");
  }
  [[nodiscard]] std::string json(std::size_t root) const {
    return fmt::format("{{\"keys\":[{}],\"values\":[{}],\"root\":{}}}", fmt::join(keys_.texts, ","),
                       fmt::join(values_.texts, ","), root);
  }

 private:
  struct Texts {
    std::size_t number_of(const std::string& text) {
      const auto [found, is_new] = numbers.try_emplace(text, texts.size());
      if (is_new) texts.push_back(text);
      return found->second;
    }
    std::unordered_map<std::string, std::size_t> numbers;
    std::vector<std::string> texts;
  };

  Texts keys_, values_;
};

}  // namespace

/// A feature: its entry in the list, and the reply to `explain`.
struct RecordedFeature {
  StudioJson feature, explanation;
  std::string label;
};

struct RecordedBuilding {
  StudioJson entry, geometry, surfaces;
  std::vector<RecordedFeature> features;
  std::map<std::string, int> numbers;

  void add(RecordedFeature added) {
    numbers.emplace(added.feature["id"], static_cast<int>(features.size()));
    features.push_back(std::move(added));
  }
};

namespace {

OpenBuilding opened(const Building& building, const PipelineResult& line) {
  OpenBuilding open;
  open.building = &building;
  open.segmented = line;
  place_features(open);
  return open;
}

RecordedFeature said_by_file(const FeatureLabel& said) {
  StudioJson none = StudioJson::array();
  const std::string& label = said.given();
  return {{{"id", said.id}, {"name", said.name}, {"kind", ""}, {"parent", -1}},
          {{"sentence", label + ": so it is called in the file"},
           {"label", label},
           {"rule", said.rule},
           {"why", none},
           {"why_not", none},
           {"flip", StudioJson()},
           {"relations", none},
           {"attributes", none},
           {"correction", StudioJson()},
           {"head", fmt::format("{} -> {} {:.2f} by {}, as the file says", said.id, label,
                                said.score.value_or(0), said.rule)}},
          label};
}

}  // namespace

struct Recording::State {
  explicit State(const RuleBase& rules)
      : all{1, rules, "", {}, {}}, classes(numbers_of_classes(rules)) {}

  std::vector<RecordedFeature> features_of(const OpenBuilding& open);
  std::string geometry_of(std::size_t number, const OpenBuilding& open);
  int class_of(const std::string& label);

  /// Of the labels only.
  LabelledBuildings all;
  /// Those of the pack, then others that a file has.
  ClassNumbers classes;
  std::vector<std::string> other_classes;
  /// Of all pictures together, so that they lie in the same place.
  std::optional<Vec3> origin_m;
  std::vector<RecordedBuilding> buildings;
  std::unordered_map<std::string, std::size_t> places;
  /// Null: there is no second picture.
  StudioJson after;
};

std::vector<RecordedFeature> Recording::State::features_of(const OpenBuilding& open) {
  std::vector<RecordedFeature> features;
  const PipelineResult& line = open.segmented;
  if (!line.is_done()) return features;
  LabelledFeatures labelled;
  labelled.building = std::shared_ptr<const OpenBuilding>(std::shared_ptr<void>(), &open);
  labelled.interpretation = line.interpretation;
  const FeatureRelations relations(all.rules, line.description.table, line.description.graph);
  const StudioJson named = features_json(open, &line.interpretation);
  for (Explanation& explanation : explain_features(line, all.rules)) {
    const FeatureId feature{static_cast<int>(features.size())};
    explanation.relations = relations.of(feature);
    std::erase_if(explanation.relations, [](const RelatedFeatures& related) {
      return related.others.size() > kMostRelated;
    });
    features.push_back({named[feature.index()],
                        explanation_json(all.rules, labelled, explanation, feature),
                        line.interpretation.verdicts[feature.index()].label.text()});
  }
  return features;
}

std::string Recording::State::geometry_of(std::size_t number, const OpenBuilding& open) {
  if (!origin_m) origin_m = open.building->frame.origin_m;
  return base64(building_bytes({{number, &open, *origin_m}}));
}

int Recording::State::class_of(const std::string& label) {
  if (label.empty()) return -1;
  const auto [found, is_new] = classes.try_emplace(label, static_cast<int>(classes.size()));
  if (is_new) other_classes.push_back(label);
  return found->second;
}

Recording::Recording(const RuleBase& rules) : state_(std::make_unique<State>(rules)) {}
Recording::~Recording() = default;

void Recording::add(const Building& building, const PipelineResult& line) {
  const OpenBuilding open = opened(building, line);
  const std::size_t number = state_->buildings.size();
  state_->places[building.id] = number;
  RecordedBuilding& recorded = state_->buildings.emplace_back();
  recorded.geometry = state_->geometry_of(number, open);
  recorded.entry = building_entry(open, &open, {*state_->origin_m});
  recorded.surfaces = surfaces_json(explain_surfaces(building, line, state_->all.rules));
  auto labels = std::make_shared<LabelledFeatures>();
  labels->since = state_->all.number;
  for (RecordedFeature& feature : state_->features_of(open)) {
    labels->classes.push_back(state_->class_of(feature.label));
    recorded.add(std::move(feature));
  }
  state_->all.buildings.push_back(std::move(labels));
}

void Recording::begin_after() { state_->after = StudioJson::array(); }

void Recording::add_after(const Building& building, const PipelineResult& line,
                          const CarriedLabels* carried) {
  const std::size_t number = state_->places.at(building.id);
  RecordedBuilding& before = state_->buildings[number];
  OpenBuilding open = opened(building, line);
  StudioJson types = StudioJson::array();
  std::vector<RecordedFeature> features;
  std::vector<std::vector<int>> owners(open.owners.polygons());
  if (carried != nullptr) {
    for (const CarriedFeature& said : carried->features) {
      for (const int polygon : said.polygons)
        owners.at(static_cast<std::size_t>(polygon)).push_back(static_cast<int>(features.size()));
      features.push_back(said_by_file(said.said));
    }
    for (auto& of_polygon : owners)
      std::ranges::stable_sort(of_polygon, {}, [&](int feature) {
        return carried->features[static_cast<std::size_t>(feature)].polygons.size();
      });
    for (const Polygon& polygon : building.polygons)
      types.push_back(carried->types.at(static_cast<std::size_t>(polygon.source)));
  } else {
    features = state_->features_of(open);
    for (std::size_t i = 0; i < owners.size(); ++i)
      owners[i].assign(open.owners[i].begin(), open.owners[i].end());
    types = surfaces_json(explain_surfaces(building, line, state_->all.rules))["types"];
  }
  std::vector<int> labels, numbers, first{0}, all;
  for (const RecordedFeature& feature : before.features)
    labels.push_back(state_->class_of(feature.label));
  for (RecordedFeature& feature : features) {
    const auto known = before.numbers.find(feature.feature["id"].get<std::string>());
    const bool is_new = known == before.numbers.end();
    numbers.push_back(is_new ? static_cast<int>(before.features.size()) : known->second);
    labels.resize(std::max(labels.size(), static_cast<std::size_t>(numbers.back()) + 1));
    labels[static_cast<std::size_t>(numbers.back())] = state_->class_of(feature.label);
    if (!is_new) continue;
    feature.feature["parent"] = -1;
    before.add(std::move(feature));
  }
  for (const auto& of_polygon : owners) {
    for (const int feature : of_polygon) all.push_back(numbers[static_cast<std::size_t>(feature)]);
    first.push_back(static_cast<int>(all.size()));
  }
  open.owners = PolygonOwners(std::move(first), std::move(all));
  state_->after.push_back({{"number", number},
                           {"geometry", state_->geometry_of(number, open)},
                           {"types", std::move(types)},
                           {"labels", std::move(labels)}});
}

std::string Recording::json() const {
  StudioJson entries = StudioJson::array(), buildings = StudioJson::array();
  for (const RecordedBuilding& recorded : state_->buildings) {
    StudioJson features = StudioJson::array(), explanations = StudioJson::array();
    for (const RecordedFeature& feature : recorded.features) {
      features.push_back(feature.feature);
      explanations.push_back(feature.explanation);
    }
    entries.push_back(recorded.entry);
    buildings.push_back({{"geometry", recorded.geometry},
                         {"features", std::move(features)},
                         {"surfaces", recorded.surfaces},
                         {"explain", std::move(explanations)}});
  }
  const RuleBase& rules = state_->all.rules;
  const StudioJson pack{{"name", rules.name() + " " + rules.version()},
                        {"path", StudioJson()},
                        {"text", ""},
                        {"hash", ""},
                        {"is_writable", false}};
  const StudioJson none = StudioJson::array();
  const StudioJson state{
      {"program", fmt::format("oriel {}", kVersion)},
      {"pack", pack},
      {"origin_m", point_json(state_->origin_m.value_or(Vec3{}))},
      {"buildings", std::move(entries)},
      {"has_truth", false},
      {"corrections", ""},
      {"scales", none},
      {"lods", none},
      {"issues", none},
      {"loading", {{"done", state_->buildings.size()}, {"all", state_->buildings.size()}}}};
  StudioJson answer{{"version", 1}, {"is_good", true}, {"findings", none}, {"ms", 0}};
  add_labels(state_->all, {}, answer);
  for (const std::string& name : state_->other_classes)
    answer["classes"].push_back({{"name", name}, {"parent", StudioJson()}, {"line", 0}});
  ValuePool pool;
  const std::size_t root = pool.number_of({{"state", state},
                                           {"pack", std::move(answer)},
                                           {"buildings", std::move(buildings)},
                                           {"after", state_->after}});
  std::string safe;
  for (const char c : pool.json(root)) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace oriel::studio
