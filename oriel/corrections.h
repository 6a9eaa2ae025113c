#pragma once

/// Corrections that people made (docs/formats.md, corrections.jsonl): read_corrections reads them,
/// Corrections finds their features, label() follows LabelOptions::corrections, and truth is made
/// of them here.
#include "interpret/labelling/corrections.h"
#include "interpret/learn/sample.h"
#include "io/records/corrections.h"  // IWYU pragma: export
#include "oriel/result.h"
#include "oriel/score.h"

#include <string>
#include <vector>

namespace oriel {

/// The features of a segmented building, row by row, as corrections find them.
std::vector<PlacedFeature> placed_features(const Building& building,
                                           const Segmentation& segmentation,
                                           const FeatureTable& table);

/// Adds to the truth of a sample what corrections say of it (objects_of_corrections), for learning.
/// Adds what Corrections::find warns of.
void add_corrections(const Corrections& corrections, Sample& sample, std::vector<Issue>& issues,
                     const ScoreOptions& options = {});

/// The same for all buildings that have predictions, by their records; also E153 for corrections of
/// others.
void add_corrections(const Corrections& corrections, LabelsAndTruth& all,
                     std::vector<Issue>& issues, const ScoreOptions& options = {});

/// What the rules said of a building before its labels were corrected.
Interpretation without_corrections(const PipelineResult& result);

}  // namespace oriel
