#pragma once

#include "model/building.h"
#include "model/description/feature_table.h"
#include "model/description/surface_table.h"
#include "model/polygon_owners.h"
#include "model/segmentation.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <array>
#include <memory>
#include <optional>
#include <span>

namespace oriel {

/// What is known of a building besides its polygons; each may be null.
struct SurfaceContext {
  /// The solid that the polygons became: it says which side of a polygon is the outer one.
  const Solid* solid = nullptr;
  /// The features, both or none: which of them a polygon belongs to.
  const Segmentation* segmentation = nullptr;
  const FeatureTable* features = nullptr;
  /// polygon_owners of the segmentation and the building, if they are known already.
  const PolygonOwners* owners = nullptr;
};

/// What is costly to measure of a surface, the cheaper first.
enum class SurfaceMeasure {
  sides,        ///< a, b
  gaps,         ///< gap_above, gap_below
  surroundings  ///< wall_up, wall_down
};
inline constexpr std::array kSurfaceMeasures = {SurfaceMeasure::sides, SurfaceMeasure::gaps,
                                                SurfaceMeasure::surroundings};

/// What sets an attribute; nothing for those that cost little.
std::optional<SurfaceMeasure> measure_of(SurfaceAttribute attribute);

/// Describes the surfaces of one building as far as it is asked to. What is measured of a surface
/// does not depend on what else is. Refers to the building, and to the solid (the context's, too),
/// which must outlive it.
class SurfaceSurvey {
 public:
  /// Fills every SurfaceAttribute that can be told without rules (all but `part`) and
  /// is no SurfaceMeasure, for every polygon of the building, whether it is closed or not: row =
  /// position in Building::polygons.
  ///
  /// The outer side of a polygon is that of the solid's facet it lies in. Without one it is told
  /// from what lies straight above and below: the topmost surface looks up, the lowest one down,
  /// and between them air and material take turns. If the polygons of which that can be said lie as
  /// their corners say with three quarters of their area, all are taken as they are; if three
  /// quarters lie the other way round, all are turned; else each as it is said of it, the others as
  /// they are. docs/describe.md#surfaces says how the rest is measured.
  explicit SurfaceSurvey(const Building& building, const Tolerances& tolerances = {},
                         const SurfaceContext& context = {});
  /// The same for some rows only: what is told of them does not depend on which. Others stay
  /// without values.
  SurfaceSurvey(const Building& building, const Tolerances& tolerances,
                const SurfaceContext& context, std::span<const int> rows);
  /// The same for the facets of a solid: row = FacetId. A facet without input polygons is
  /// synthetic.
  explicit SurfaceSurvey(const Solid& solid, const Tolerances& tolerances = {});
  SurfaceSurvey(SurfaceSurvey&&) noexcept;
  ~SurfaceSurvey();

  /// Fills the attributes of `what` in `rows`, where they can be told.
  void measure(SurfaceMeasure what, std::span<const int> rows);
  /// What was filled so far. Attributes may be set that stand nowhere yet (`part`).
  [[nodiscard]] SurfaceTable& table();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// SurfaceSurvey with everything measured.
SurfaceTable describe_surfaces(const Building& building, const Tolerances& tolerances = {},
                               const SurfaceContext& context = {});
SurfaceTable describe_facets(const Solid& solid, const Tolerances& tolerances = {});

}  // namespace oriel
