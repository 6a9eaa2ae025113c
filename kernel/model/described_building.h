#pragma once

#include "kernel/model/description/feature_graph.h"
#include "kernel/model/description/feature_table.h"

namespace oriel {

/// A building as rules see it.
struct DescribedBuilding {
  FeatureTable table;
  FeatureGraph graph;
};

}  // namespace oriel
