#pragma once

#include "kernel/base/work.h"
#include "model/building.h"
#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"
#include "model/segmentation.h"

#include <vector>

namespace oriel {

/// What is known of the features of one building without any rule: their attributes and how they
/// stand to each other.
struct Description {
  FeatureTable table;
  FeatureGraph graph;
  /// E502 if the work budget was used up: relations and places that were not looked at by then are
  /// missing.
  std::vector<Issue> issues = {};
};

/// What somebody reads of a description: the rest may be missing.
struct DescribeOptions {
  /// By column of feature_schema() and by position in relation_schema(); empty: all are read.
  std::vector<bool> attributes;
  std::vector<bool> relations;
  /// Pairs of features, walls and corners that may be looked at; then E502.
  std::int64_t budget = kWorkBudget;
};

/// Fills every attribute of feature_schema() that can be told, and every relation of
/// relation_schema().
///
/// Ids are made of the building, its level of detail, the host plane, and the place and size of the
/// feature to the millimetre: they do not depend on the order of the input. Source: paper 5.1
/// (dimensions, difference of bounding boxes) and 5.2 (inclination, height over ground, similarity,
/// containment); docs/describe.md says how each is measured.
Description describe(const Building& building, const Segmentation& segmentation,
                     const DescribeOptions& options = {});

}  // namespace oriel
