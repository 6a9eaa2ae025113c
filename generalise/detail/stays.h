#pragma once

#include "kernel/model/segmentation.h"
#include "kernel/model/solid.h"

#include <vector>

namespace oriel::detail {

/// A feature that is to stay would lose all its surface: none of its input polygons are named by a
/// facet of `left`, but some are by one of `before`. `gone`: features that go, with all that goes
/// along. What has the polygons of features that are gone was made of them, and is not asked for.
bool loses_what_stays(const Solid& before, const Solid& left, const Segmentation& segmentation,
                      const std::vector<FeatureId>& gone);

}  // namespace oriel::detail
