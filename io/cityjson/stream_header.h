#pragma once

#include "model/vec3.h"

#include <optional>
#include <string>
#include <string_view>

namespace oriel {

/// What the lines behind a CityJSON header depend on: version, transform and reference system, as
/// one JSON text. `header` is a JSON object. Lines behind headers with the same facts may share one
/// header.
std::string stream_header_facts(std::string_view header);

/// What files depend on that become one file, whatever their grids: version, reference system, and
/// a hash of the geometry templates if there are any.
std::string file_facts(std::string_view header);

/// The id of a feature as the line of a CityJSONSeq has it; empty without one.
std::string feature_id(std::string_view line);

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
