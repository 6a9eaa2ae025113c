#pragma once

#include "model/description/feature_graph.h"
#include "model/description/feature_table.h"

#include <string>
#include <vector>

namespace oriel::bench {

/// One building of the synthetic facade features of ../shared/peers/rules/gen.py.
struct FacadeBuilding {
  FeatureTable table;
  /// By row: its facade, and the row that it stands on or -1.
  std::vector<int> facades;
  std::vector<int> hosts;
};

/// Reads gen.py's CSV. Numbers are copied; a wall inclines by 90 degrees, a roof by 30, and what a
/// feature stands on has no inclination; `edge_gap` is the position along the facade.
std::vector<FacadeBuilding> read_facade_features(const std::string& path);

/// same_facade, host and contains, as the peers find them within their time.
FeatureGraph relate(const FacadeBuilding& building);

}  // namespace oriel::bench
