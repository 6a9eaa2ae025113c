#pragma once

#include "kernel/describe/features/shape.h"
#include "kernel/model/description/feature_graph.h"
#include "kernel/model/segmentation.h"

#include <vector>

namespace oriel::detail {

/// What counts and compares as the same: an imprint is an opening without depth.
inline Sense kind_of(Sense sense) { return sense == Sense::imprint ? Sense::hole : sense; }

/// A feature as seen in its facade: intervals along the facade's horizontal and in height.
struct InFacade {
  int facade = -1;                 ///< -1: none
  Sense kind = Sense::protrusion;  ///< see kind_of
  Extent across;
  Extent height;
  double a = 0, b = 0;
};

/// Facades: features whose largest caps lie in the same facet share a number, counted in feature
/// order; -1 without cap. What an imprint owns has the imprint as its facade, as what stands in a
/// recess has the back of the recess.
std::vector<int> facades_of(const Segmentation& segmentation);

/// Storeys: openings (holes and imprints in steep facets) grouped by height, two of them together
/// if their overlap is at least half of the taller; numbered from the lowest. -1: in no storey.
std::vector<int> storeys_of(const std::vector<InFacade>& features,
                            const std::vector<char>& is_opening);

/// Which of the relations between features of one facade are asked for, that are found pair by
/// pair.
struct AskedRelations {
  bool alike = true, beside = true, above = true;
};

/// All relations of relation_schema() but those that are not asked for, which stay empty.
FeatureGraph relate(const Segmentation& segmentation, const std::vector<InFacade>& features,
                    const std::vector<int>& storeys, const AskedRelations& asked);

}  // namespace oriel::detail
