#pragma once

#include "kernel/model/vec3.h"

#include <optional>
#include <string_view>

namespace oriel {

/// Where the features of a CityJSONSeq stand.
class FeaturePlace {
 public:
  /// `header` is the stream's header line as Reader has read it.
  explicit FeaturePlace(std::string_view header);
  /// The middle of the box of a feature's vertices, in the input's coordinates; nothing without
  /// vertices. `feature` is a line that Reader has read.
  [[nodiscard]] std::optional<Vec3> middle_of(std::string_view feature) const;

 private:
  Vec3 scale_, translate_;
};

}  // namespace oriel
