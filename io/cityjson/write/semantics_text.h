#pragma once

#include "model/labelled_building.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// How the polygons of a geometry are nested.
struct GeometryShape {
  /// As GeometryKind::depth: 0 surfaces, 1 shells, 2 solids.
  int depth = 0;
  /// The number of polygons of each shell of each solid; one solid, one shell where there are none.
  std::vector<std::vector<int>> counts;
};

/// Appends what the label says to the object that is being written.
void append_label(std::string& out, const SharedLabel& label);

/// For each polygon of a geometry the number of its surface in "semantics", or -1.
std::vector<int> surface_numbers(std::string_view semantics, const GeometryShape& shape);

/// The text of a geometry's "semantics" in which every polygon without a semantic surface has the
/// one that `surface_of_polygon` names (-1, or too short: none). `existing` is the text that is
/// there, or empty. Surfaces that are there keep their numbers and gain `children`; of ours only
/// those that a polygon takes are added. An opening whose wall is labelled already has that as its
/// parent, but not if what is there is to be kept. Where ours say why they are, those that
/// are there and have none gain one, too: that they were kept, and what ours would have been.
/// Returns `existing` if there is nothing to add.
std::string filled_semantics(std::string_view existing, const GeometryShape& shape,
                             std::span<const int> surface_of_polygon,
                             const std::vector<SemanticSurface>& surfaces, bool is_kept = false);

/// The text of "semantics" for a geometry whose polygons are made of those of another one: what
/// all that a polygon is made of (`sources`, numbers in the old geometry) have in common, if
/// anything. The surfaces stay as they are. Empty if `existing` is.
std::string carried_semantics(std::string_view existing, const GeometryShape& old_shape,
                              const GeometryShape& shape,
                              const std::vector<std::vector<int>>& sources);

}  // namespace oriel::detail
