#pragma once

#include "oriel/score.h"

#include <map>
#include <string>
#include <vector>

namespace oriel::cli {

/// A line for each building and class, then one for all its classes together ("all"), as CSV:
/// building, class, tp, fp, fn, precision, recall, f1. Ratios without a denominator are empty.
std::string per_building_csv(const std::map<std::string, Score>& buildings);

/// A line for each point: class, threshold, tp, fp, fn, precision, recall, f1; class by class, the
/// highest threshold first.
std::string curve_csv(const std::vector<CurvePoint>& curve);

/// A line for each match, in their order (docs/formats.md): building, feature, name, label, score,
/// rule, truth, class, iou, outcome. What is not there is empty.
std::string joined_csv(const std::vector<ObjectMatch>& matches);

}  // namespace oriel::cli
