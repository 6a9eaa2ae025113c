#pragma once

#include "kernel/model/feature_graph.h"
#include "kernel/model/feature_table.h"

namespace oriel {

/// A building as rules see it.
struct DescribedBuilding {
  FeatureTable table;
  FeatureGraph graph;
};

}  // namespace oriel
