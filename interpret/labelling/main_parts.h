#pragma once

#include "interpret/plan/profile.h"
#include "kernel/model/description/feature_table.h"
#include "kernel/model/segmentation.h"

#include <vector>

namespace oriel::detail {

/// Which features are parts of a building, not details on it, though they are short or thin. No
/// such feature goes for its size. Profile::MainPart says when.
class MainParts {
 public:
  MainParts(const Segmentation& segmentation, const FeatureTable& table,
            const Profile::MainPart& part, const Thresholds& sizes);

  /// The whole building is smaller than the least that the sizes let stand alone, or the feature is
  /// a storey, or a part of the main roof.
  [[nodiscard]] bool has(FeatureId id) const;

  /// Of features that go for their size the highest one, if without them the top of the building
  /// would sink by more than c, the height that a level is true to; else invalid. By feature:
  /// `goes` what goes, with all that it carries, `goes_for_size` what goes for its size.
  [[nodiscard]] FeatureId holder_of_ridge(const std::vector<char>& goes,
                                          const std::vector<char>& goes_for_size) const;

 private:
  const Segmentation& segmentation_;
  const FeatureTable& table_;
  const Profile::MainPart& part_;
  const Thresholds& sizes_;
  double building_m3_ = 0;
};

}  // namespace oriel::detail
