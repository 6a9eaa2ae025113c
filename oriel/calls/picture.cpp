#include "oriel/picture.h"

#include "io/mesh/mesh_writer.h"
#include "kernel/base/index.h"
#include "kernel/base/text/counted.h"
#include "oriel/explain.h"
#include "oriel/score.h"
#include "oriel/write.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel {

namespace {

using PartMarks = decltype(PicturePanel::marks);
using FeatureName = std::pair<std::string, std::string>;

FeatureName name_of(const MeshFeature& feature) { return {feature.building, feature.id}; }

struct PlacedPart {
  Box box;
  std::string label;
};

std::map<FeatureName, PlacedPart> parts_of(const MeshSource& mesh) {
  std::map<FeatureName, PlacedPart> parts;
  for (const MeshPolygon& polygon : mesh.polygons) {
    if (polygon.feature < 0) continue;
    const MeshFeature& feature = mesh.features[at(polygon.feature)];
    if (feature.id.empty()) continue;
    PlacedPart& part = parts[name_of(feature)];
    part.label = feature.label;
    for (const auto& ring : polygon.rings)
      for (const int v : ring) part.box.grow(mesh.points[at(v)]);
  }
  return parts;
}

/// A part that has moved or grown by less looks the same.
constexpr double kSamePlace_m = 0.01;

bool is_same(const PlacedPart& p, const PlacedPart& q) {
  return p.label == q.label && length(p.box.min - q.box.min) < kSamePlace_m &&
         length(p.box.max - q.box.max) < kSamePlace_m;
}

/// Makes polygons a part of their own. False if the building has none of them.
bool name_part(const std::vector<int>& polygons, const std::string& id, const std::string& label,
               LabelledBuilding& labelled) {
  std::map<int, int> named;  // by the surface that a polygon had
  for (const int polygon : polygons) {
    if (polygon < 0 || at(polygon) >= labelled.surface_of_polygon.size()) continue;
    int& surface = labelled.surface_of_polygon[at(polygon)];
    const auto [found, is_new] =
        named.try_emplace(surface, static_cast<int>(labelled.surfaces.size()));
    if (is_new) {
      const std::string type = surface < 0 ? "" : labelled.surfaces[at(surface)].type;
      labelled.surfaces.push_back({.type = type, .label = FeatureLabel{.id = id, .label = label}});
    }
    surface = found->second;
  }
  return !named.empty();
}

std::string name_of_truth(const ExpectedObject& object) { return "truth " + object.id; }

/// What is in one of two panels only, lies elsewhere in the other one, or has another label.
PartMarks differences(const MeshSource& before, const MeshSource& after) {
  const auto old = parts_of(before), now = parts_of(after);
  PartMarks marks;
  for (const auto& [name, part] : old)
    if (const auto found = now.find(name); found == now.end() || !is_same(part, found->second))
      marks[name] = PictureMark::changed;
  for (const auto& [name, part] : now)
    if (!old.contains(name)) marks[name] = PictureMark::changed;
  return marks;
}

/// A feature, what it is part of, and those near it. Those without a label become parts of
/// `labelled`.
PartMarks explained_marks(const Building& building, const PipelineResult& result, FeatureId feature,
                          LabelledBuilding& labelled) {
  const FeatureTable& table = result.description.table;
  PartMarks marks;
  const auto mark = [&](FeatureId id, PictureMark as) { marks[{building.id, table.id(id)}] = as; };
  for (const char* relation : {"contains", "inside", "beside", "above", "host"})
    for (const auto& [self, other] : result.description.graph.pairs(relation)) {
      if (self == feature) mark(other, PictureMark::related);
      if (other == feature) mark(self, PictureMark::related);
    }
  for (const FeatureId host : result.description.graph.others("host", feature))
    mark(host, PictureMark::host);
  mark(feature, PictureMark::explained);

  std::vector<FeatureRecord> records = feature_records(building, result);
  // What is in another part is named after it.
  std::ranges::stable_sort(records, std::ranges::greater{}, [](const FeatureRecord& record) {
    return record.source_polygons.size();
  });
  for (const FeatureRecord& record : records)
    if (record.label.empty() && marks.contains({building.id, record.id}))
      name_part(record.source_polygons, record.id, "unlabelled", labelled);
  return marks;
}

/// What is marked, alone.
MeshSource marked_only(const PicturePanel& panel) {
  MeshSource mesh = panel.mesh;
  std::erase_if(mesh.polygons, [&](const MeshPolygon& polygon) {
    return polygon.feature < 0 ||
           !panel.marks.contains(name_of(mesh.features[at(polygon.feature)]));
  });
  MeshSource made;
  made.features = mesh.features;
  std::map<int, int> kept;
  for (MeshPolygon& polygon : mesh.polygons) {
    for (auto& ring : polygon.rings)
      for (int& v : ring) {
        const auto [found, is_new] = kept.try_emplace(v, static_cast<int>(made.points.size()));
        if (is_new) made.points.push_back(mesh.points[at(v)]);
        v = found->second;
      }
    made.polygons.push_back(std::move(polygon));
  }
  return made;
}

/// "1:5000: 12 openings": windows and doors by the type of their surfaces, whatever a pack calls
/// them.
std::string drawn_caption(const std::string& target, const MeshSource& mesh) {
  std::set<int> openings;
  for (const MeshPolygon& polygon : mesh.polygons)
    if (is_opening_type(polygon.surface)) openings.insert(polygon.feature);
  return fmt::format("{}: {}", target, counted(openings.size(), "opening"));
}

/// "omit 24, enlarge 3, 2 refused": what was done, by operator.
std::string done_caption(const TargetReport& report) {
  std::map<std::string, std::size_t> done;
  std::size_t refused = 0;
  for (const FeatureOutcome& change : report.changes) {
    refused += change.outcome == "refused" ? 1 : 0;
    if (change.outcome == "omitted" || change.outcome == "changed") ++done[change.operation];
  }
  std::vector<std::string> texts;
  for (const auto& [operation, count] : done)
    texts.push_back(fmt::format("{} {}", operation, count));
  if (refused > 0) texts.push_back(fmt::format("{} refused", refused));
  return texts.empty() ? "nothing was done" : fmt::format("{}", fmt::join(texts, ", "));
}

LabelledBuilding labelled(const Building& building, const PipelineResult& result,
                          const RuleBase& rules, const LabelOptions& options) {
  if (result.has_surfaces()) return annotate(building, result, rules, options);
  LabelledBuilding bare;
  bare.building = building.id;
  return bare;
}

}  // namespace

void append_labelled(PicturePanel& panel, const Building& building, const PipelineResult& result,
                     const RuleBase& rules, const LabelOptions& options) {
  append_building(panel.mesh, building, labelled(building, result, rules, options));
}

ComparedCounts& ComparedCounts::operator+=(const ComparedCounts& other) {
  right += other.right;
  wrong += other.wrong;
  missed += other.missed;
  without_polygons += other.without_polygons;
  return *this;
}

std::string ComparedCounts::text() const {
  std::string text = fmt::format("{} right, {} wrong, {} missed", right, wrong, missed);
  if (without_polygons > 0) text += fmt::format(" ({} of them without polygons)", without_polygons);
  return text;
}

ComparedCounts append_compared(PicturePanel& panel, const Building& building,
                               const PipelineResult& result, const RuleBase& rules,
                               const LabelOptions& options, const GroundTruth& truth) {
  LabelledBuilding shown = labelled(building, result, rules, options);
  LabelsAndTruth all;
  add(feature_records(building, result), all);
  add(truth, all);
  std::map<std::string, const TruthObject*> objects;
  for (const TruthObject& object : truth.objects) objects[object.id] = &object;
  ComparedCounts counts;
  for (const ObjectMatch& match : match_features(all)) {
    const auto mark = [&](const std::string& id, PictureMark as) {
      panel.marks[{building.id, id}] = as;
    };
    switch (match.outcome) {
      case MatchOutcome::right:
        mark(match.prediction->id, PictureMark::right);
        ++counts.right;
        break;
      case MatchOutcome::wrong_class:
      case MatchOutcome::nothing_there:
        mark(match.prediction->id, PictureMark::wrong);
        ++counts.wrong;
        break;
      case MatchOutcome::not_found:
        ++counts.missed;
        if (name_part(objects.at(match.truth->id)->faces, name_of_truth(*match.truth),
                      match.truth->label, shown))
          mark(name_of_truth(*match.truth), PictureMark::missed);
        else
          ++counts.without_polygons;
        break;
      case MatchOutcome::left_out:
        break;
    }
  }
  append_building(panel.mesh, building, shown);
  return counts;
}

std::vector<PicturePanel> explained_panels(const Building& building, const PipelineResult& result,
                                           const RuleBase& rules, const LabelOptions& options,
                                           FeatureId feature) {
  LabelledBuilding shown = labelled(building, result, rules, options);
  PicturePanel whole{
      .frame = 0, .marks = explained_marks(building, result, feature, shown), .fades_others = true};
  append_building(whole.mesh, building, shown);
  PicturePanel alone{.mesh = marked_only(whole),
                     .frame = 1,
                     .marks = whole.marks,
                     .hides_backs = result.is_solid()};
  whole.caption = plain_sentence(result, result.interpretation, feature);
  const std::string why = summary_text(explain(result, rules, feature));
  alone.caption = why.substr(0, why.find('\n'));
  return {std::move(whole), std::move(alone)};
}

std::vector<PicturePanel> target_panels(const Document& document, const Building& building,
                                        const PipelineResult& result, const RuleBase& rules,
                                        const std::vector<Targets>& targets,
                                        const LabelOptions& options, int frame,
                                        std::vector<Issue>& issues) {
  std::vector<PicturePanel> panels{{.frame = frame}};
  append_labelled(panels.front(), building, result, rules, options);
  panels.front().caption = drawn_caption(building.id, panels.front().mesh);
  GeneraliseOptions with;
  static_cast<LabelOptions&>(with) = options;
  with.reports_changes = true;
  for (const Targets& target : targets) {
    GeneralisedBuilding drawn = generalise(document, building, result, rules, target, with);
    for (const Issue& issue : drawn.issues) {
      const auto is_said = [&](const Issue& said) { return said.sentence == issue.sentence; };
      if (std::ranges::none_of(issues, is_said)) issues.push_back(issue);
    }
    const std::string done = drawn.reports.empty() ? "" : done_caption(drawn.reports.front());
    OutputRecord output;
    add(std::move(drawn), output);
    PicturePanel& panel =
        panels.emplace_back(PicturePanel{.frame = frame, .map_scale = target.scale.value_or(0)});
    for (const LabelledBuilding& one : output.buildings) append_building(panel.mesh, building, one);
    panel.caption = output.buildings.empty()
                        ? target.text() + ": not drawn"
                        : drawn_caption(target.text(), panel.mesh) + '\n' + done;
  }
  return panels;
}

void mark_changes(std::vector<PicturePanel>& panels) {
  for (std::size_t i = 1; i < panels.size(); ++i)
    panels[i].marks = differences(panels.front().mesh, panels[i].mesh);
  if (panels.size() == 2) panels.front().marks = panels.back().marks;
}

}  // namespace oriel
