#pragma once

#include "kernel/segment/removal/feature_cut.h"
#include "tests/support/segmented.h"

#include <vector>

namespace oriel::test {

/// What a cut of a feature is asked for by.
struct AskedCut {
  const Feature& feature;
  int plane, direction;
  bool is_material;
};

/// A body that is asked for the cuts of its features.
struct CutBody {
  explicit CutBody(const Segmented& from)
      : s(from), world(s.solid), body(boundary_of(s.solid, 0, world)) {}

  /// Calls visit(asked, by_section) for each feature of one plane, as the body is by then.
  template <class Visit>
  void for_each_cut(Visit visit) {
    for (const Feature& f : s.segmentation.features) {
      const bool is_material = f.sense == Sense::protrusion;
      if (f.planes.size() != 1 || (!is_material && f.sense != Sense::hole)) continue;
      const auto side = world.planes.find(s.segmentation.planes[f.planes[0].index()]);
      if (!side) continue;
      const int direction = ((*side & 1) == 0) == is_material ? 1 : -1;
      visit(AskedCut{f, *side >> 1, direction, is_material},
            find_feature_cut(body, *side >> 1, direction, is_material, f.cap_point,
                             {-1, 0.001, false, true}));
    }
  }

  const Segmented& s;
  detail::World world;
  detail::Boundary body;
};

/// Loop by loop, half-edge by half-edge.
inline std::vector<std::vector<EdgeId>> rims_of(const detail::CutCap& cap) {
  std::vector<std::vector<EdgeId>> rims;
  for (const detail::CapLoop& loop : cap.loops) {
    rims.emplace_back();
    for (const detail::CapEdge& edge : loop.edges) rims.back().push_back(edge.rim);
  }
  return rims;
}

}  // namespace oriel::test
