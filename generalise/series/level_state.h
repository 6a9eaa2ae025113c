#pragma once

#include "kernel/base/issue.h"
#include "model/building.h"
#include "model/labelled_building.h"
#include "model/scale_series.h"

#include <functional>
#include <string>

namespace oriel {

/// Where a point of the building's frame comes to lie in the file.
using Placer = std::function<MicrometrePoint(Vec3 local_m)>;

/// Two facets of a building have the same outer ring in the file: no state tells them apart. A
/// valid solid has none such.
class DoubledFacet : public GeometryError {
 public:
  explicit DoubledFacet(const MicrometrePoint& corner)
      : GeometryError("two facets have the same outer ring"), corner_(corner) {}
  /// Of the ring.
  [[nodiscard]] const MicrometrePoint& corner() const { return corner_; }

 private:
  MicrometrePoint corner_;
};

/// The state of a building that has a geometry of its own, with vertices where the file has them.
/// Vertices that become one are one; facets of which less than a triangle is left vanish. Of the
/// attributes those belong to it that is_of_state(). Throws DoubledFacet.
LevelState level_state(const LabelledBuilding& labelled, const Placer& place);

/// The building of a state, to be written: facets in the order of the state. Facets with the same
/// FeatureLabel::id have one semantic surface, others each their own; the parent of an opening is
/// the surface other than an opening that it shares most of its edges with, by length. Shells are
/// what hangs together by edges; one that encloses no volume but is turned inwards is a cavity of
/// the smallest body around it. Without facets it has no geometry.
LabelledBuilding labelled_building(const LevelState& state, const Frame& frame);

/// The state as a building that was read: its facets are the polygons of solids.
Building building_of(const LevelState& state, const Frame& frame);

}  // namespace oriel
