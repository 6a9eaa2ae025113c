#pragma once

#include "kernel/base/code.h"
#include "kernel/base/work.h"
#include "kernel/segment/segment.h"
#include "model/segmentation.h"
#include "model/solid.h"

#include <string>
#include <vector>

namespace oriel {

/// A feature that could not be taken off, and why.
struct Refusal {
  FeatureId feature;
  std::string reason;
  Code code = Code::G401;
};

/// What is left of a solid when features are taken off it.
struct Remainder {
  /// Closed; facets are maximal, so neither filled holes nor cut protrusions leave seams.
  /// Facet::polygons are the input polygons that a facet still has parts of. No facets at all if
  /// nothing is left.
  Solid solid;
  /// The features that are gone: those asked for and all that sat on or in them. Ascending.
  std::vector<FeatureId> removed;
  std::vector<Refusal> refused;
};

/// These features and what sits on (Feature::host) or in (Feature::parent) them, directly or over
/// others; ascending.
std::vector<FeatureId> with_what_sits_on(const Segmentation& segmentation,
                                         const std::vector<FeatureId>& features);

/// Takes features off the solid that was segmented: protrusions are cut, holes and cavities filled,
/// each by its own planes, in the order in which the segmentation found them. An imprint leaves no
/// trace in the solid: its input polygons are no longer named by the facet.
///
/// What sits on a removed feature goes with it (a window with its dormer). A feature whose cut
/// would take others along that are to stay is refused, as is one whose cut is not found any more;
/// the solid is then as if it had not been asked for. `segmentation` must be the one of `solid`,
/// made with the same options.
///
/// What has to be done again for a feature that is refused late is counted in `work`, if that is
/// given. Once it is used up nothing is taken off, and all are refused (E502).
Remainder remove_features(const Solid& solid, const Segmentation& segmentation,
                          const std::vector<FeatureId>& features,
                          const SegmentOptions& options = {}, Work* work = nullptr);

}  // namespace oriel
