#pragma once

#include "kernel/base/issue.h"
#include "model/description/feature_table.h"
#include "model/segmentation.h"
#include "model/solid.h"
#include "oriel/drawing/output_check.h"

#include <vector>

namespace oriel {

/// Of imprints whose outlines are in the way of a valid solid when it is written.
class FaultyImprints {
 public:
  /// Adds those drawn in `solid` that lie in the planes of facets that are not valid as they are
  /// written, and from the third time on all. False if there are no more than were known.
  bool add(OutputCheck& check, const Segmentation& segmentation, const Solid& solid);

  /// Ascending.
  [[nodiscard]] const std::vector<FeatureId>& ids() const { return ids_; }

  /// The warnings G410 that say so.
  [[nodiscard]] std::vector<Issue> issues(const FeatureTable& table) const;

 private:
  std::vector<FeatureId> ids_;
  int times_ = 0;
};

}  // namespace oriel
