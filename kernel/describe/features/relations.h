#pragma once

#include "kernel/base/work.h"
#include "kernel/describe/features/shape.h"
#include "model/description/feature_graph.h"
#include "model/segmentation.h"

#include <span>
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

/// Storeys: openings (holes and imprints in steep facets) grouped by height, two of them together
/// if their overlap is at least half of the taller; numbered from the lowest. -1: in no storey.
std::vector<int> storeys_of(std::span<const InFacade> features, std::span<const char> is_opening);

/// Which of the relations between features of one facade are asked for, that are found pair by
/// pair.
struct AskedRelations {
  bool alike = true, beside = true, above = true;
};

/// All relations of relation_schema() but those that are not asked for, which stay empty. Once
/// `work` is used up no more pairs of one facade are looked at.
FeatureGraph relate(const Segmentation& segmentation, std::span<const InFacade> features,
                    std::span<const int> storeys, const AskedRelations& asked, Work& work);

}  // namespace oriel::detail
