#pragma once

#include "interpret/score/area_score.h"
#include "interpret/score/match.h"
#include "interpret/score/paired.h"
#include "interpret/score/rule_score.h"
#include "interpret/score/score.h"
#include "interpret/score/score_spread.h"
#include "interpret/score/surface_score.h"
#include "io/records/feature_records.h"
#include "io/records/truth.h"
#include "model/building.h"
#include "oriel/label.h"
#include "oriel/result.h"

#include <map>
#include <string>
#include <vector>

namespace oriel {

/// What a labelling found and what is there, of the same buildings. The headers of
/// interpret/score say how they are compared; to_text() and to_json() there write the results.
struct LabelsAndTruth {
  std::vector<Prediction> predictions;
  std::vector<ExpectedObject> truth;
  /// Their polygons, by building.
  std::map<std::string, FacesOfBuilding> faces;
};

/// Adds the labels of features: those of feature_records(), or of read_feature_records().
void add(std::vector<FeatureRecord> records, LabelsAndTruth& all);
/// Adds the true objects of a building (read_truths).
void add(const GroundTruth& truth, LabelsAndTruth& all);

/// Precision, recall, confusion and misses of every building that has truth or predictions, by
/// their boxes. total() sums them up, bootstrap() says how far they spread, PairedComparer compares
/// those of two runs (paired_outcomes).
std::map<std::string, Score> score_by_building(const LabelsAndTruth& all,
                                               const ScoreOptions& options = {});

/// Every feature with a label and every true object, with what it is compared with.
std::vector<ObjectMatch> match_features(const LabelsAndTruth& all,
                                        const ScoreOptions& options = {});

/// How both depend on the least score of a label.
std::vector<CurvePoint> precision_recall_curve(const LabelsAndTruth& all,
                                               const ScoreOptions& options = {});

/// Compares the polygons of a building instead of boxes, and adds their areas to `score`. False if
/// there are neither predictions nor truth of it.
bool compare_areas(const Building& building, const LabelsAndTruth& all, const ScoreOptions& options,
                   AreaScore& score);

/// Adds how the names of a building's surfaces agree with the semantics that it came with.
/// `result` is what label() said of it with the same rules and options, and with
/// LabelOptions::measures_surfaces; it has_surfaces().
void compare_surfaces(const Building& building, const PipelineResult& result, const RuleBase& rules,
                      const LabelOptions& options, OpeningPolicy policy, SurfaceScore& score);

}  // namespace oriel
