#include "oriel/score.h"

#include <utility>

namespace oriel {

void add(std::vector<FeatureRecord> records, LabelsAndTruth& all) {
  for (FeatureRecord& r : records) {
    const auto& b = r.aabb_m;
    all.predictions.push_back({r.building,
                               r.id,
                               r.label,
                               {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}},
                               r.score.value_or(0),
                               r.rule,
                               r.runner_up,
                               r.name});
    all.faces[r.building].predictions.push_back({r.id, r.label, std::move(r.source_polygons)});
  }
}

void add(const GroundTruth& truth, LabelsAndTruth& all) {
  FacesOfBuilding& faces = all.faces[truth.building];
  faces.left_out = truth.capped_faces;
  for (const TruthObject& o : truth.objects) {
    ExpectedObject object{
        truth.building,  o.id, o.label, o.subclass, o.feature_aabb.value_or(o.aabb),
        !o.faces.empty()};
    if (is_left_out(object))
      faces.left_out.insert(faces.left_out.end(), o.faces.begin(), o.faces.end());
    faces.truth.push_back({o.id, o.label, o.faces});
    if (o.feature_aabb) faces.niches[o.id] = *o.feature_aabb;
    all.truth.push_back(std::move(object));
  }
}

std::map<std::string, Score> score_by_building(const LabelsAndTruth& all,
                                               const ScoreOptions& options) {
  return score_by_building(all.predictions, all.truth, options);
}

std::vector<ObjectMatch> match_features(const LabelsAndTruth& all, const ScoreOptions& options) {
  return match_features(all.predictions, all.truth, options);
}

std::vector<CurvePoint> precision_recall_curve(const LabelsAndTruth& all,
                                               const ScoreOptions& options) {
  return precision_recall_curve(all.predictions, all.truth, options);
}

bool compare_areas(const Building& building, const LabelsAndTruth& all, const ScoreOptions& options,
                   AreaScore& score) {
  const auto faces = all.faces.find(building.id);
  if (faces == all.faces.end()) return false;
  compare_areas(building, faces->second, options.not_scored, score);
  return true;
}

void compare_surfaces(const Building& building, const PipelineResult& result, const RuleBase& rules,
                      const LabelOptions& options, OpeningPolicy policy, SurfaceScore& score) {
  compare_surfaces(building, annotate(building, result, rules, options), result.surfaces, policy,
                   score);
}

}  // namespace oriel
