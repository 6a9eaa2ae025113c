#pragma once

#include "model/building.h"
#include "model/description/surface_table.h"
#include "model/labelled_building.h"
#include "model/vec3.h"

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// A polygon that is called one thing and another.
struct SurfaceDifference {
  std::string building;
  /// Polygon::source.
  int polygon = -1;
  /// What the input says, and what the rules say.
  std::string theirs;
  std::string ours;
  double area_m2 = 0;
  /// The middle of its box, in the input's coordinates.
  Vec3 place;
};

/// How two namings of the same polygons agree, by area.
struct SurfaceScore {
  /// (theirs, ours) -> m².
  std::map<std::pair<std::string, std::string>, double> area_m2;
  std::size_t polygons = 0;
  /// Of polygons that they give no name.
  double unnamed_m2 = 0;
  /// Of polygons that they call Window or Door, where those are left out.
  double openings_m2 = 0;
  /// In the order of the buildings and their polygons.
  std::vector<SurfaceDifference> differences;

  /// Of the area that they call `type`, the share that we call so too; NaN without such an area.
  [[nodiscard]] double recall(const std::string& type) const;
  /// Of the area that we call `type`, the share that they call so too; NaN without such an area.
  [[nodiscard]] double precision(const std::string& type) const;
  /// Of all compared area, the share on which both agree; NaN if nothing was compared.
  [[nodiscard]] double agreement() const;
};

enum class OpeningPolicy {
  /// Openings are compared as Window and Door; but what we call one agrees with the name of the
  /// surface it lies in, too: reveals belong to the opening in our naming, to the wall in others'.
  compare,
  /// Polygons that they call Window or Door are left out (`score` of features compares those), and
  /// what we call Window or Door counts as the surface it lies in.
  as_host
};

/// Adds a building: what its polygons' hints say (semantics of the input) is compared with
/// `labelled`. `surfaces` has the areas of its polygons, row by row.
void compare_surfaces(const Building& building, const LabelledBuilding& labelled,
                      const SurfaceTable& surfaces, OpeningPolicy policy, SurfaceScore& score);

/// A table for a terminal: a line a type, what was taken for what, the share on which both agree.
std::string to_text(const SurfaceScore& score);

/// The same as one JSON object on one line (docs/formats.md); `with_differences`: also each of
/// them.
std::string to_json(const SurfaceScore& score, bool with_differences = false);

/// The differences as lines for a terminal, the largest area first; of equal areas in their order.
std::string differences_text(const SurfaceScore& score);

}  // namespace oriel
