#pragma once

#include "model/vec3.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// Which holes of a shell are closed by faces of oriel's own.
enum class Closing {
  /// None.
  none,
  /// Those of up to RepairOptions::cap_area_m2, by one plane face or several.
  planar,
  /// Those, and of any size a missing ground and missing upright walls (CapKind). Larger holes
  /// elsewhere, those in roofs, stay open.
  ground,
  /// Those of any size; larger ones only if the smaller ones do not close the building.
  any
};

/// What becomes of polygons that run through each other, or lie on each other with crossing edges.
enum class Crossings {
  /// They stay whole: what leaks there stays open.
  leave,
  /// They are cut along the lines in which they meet, where the building is open without that.
  cut,
  /// So is what is closed, and it becomes the boundary of its inside.
  cut_closed
};

/// How much of a building that is no solid may be changed.
struct RepairOptions {
  Closing close = Closing::ground;
  /// 10 m²: what windows, garage doors and shop fronts measure whose panes stand loose behind
  /// unfilled holes; a missing wall, roof or ground is larger.
  double cap_area_m2 = 10;
  Crossings crossings = Crossings::leave;
  /// Facets of oriel's own stay facets of their own in the plane of a neighbour, too: to be written
  /// as what they are. False: facets are maximal, as all that cuts needs them.
  bool keeps_caps_apart = false;
};

/// An edge of one polygon only, in metres of the frame, as the polygon goes along it.
struct OpenEdge {
  Vec3 from, to;
  int polygon = -1;  ///< Polygon::source
};

/// What a face that closes a hole stands for (docs/solidify.md, "What is closed"). It depends on
/// neither the order of vertices and polygons nor the way round they run.
enum class CapKind {
  hole,
  /// Level within 5°, the polygons along more than half of its rim rise from it, and nothing of the
  /// building lies beneath it.
  ground,
  /// Upright within 5°: a party wall, say.
  wall
};

/// A face that oriel made to close a hole.
struct Cap {
  double area_m2 = 0;
  Vec3 centre;  ///< the mean of its corners, metres of the frame
  /// In a report a wall of no more than RepairOptions::cap_area_m2 is a hole.
  CapKind kind = CapKind::hole;
};

/// What solidify() did to a building that was no solid as it came. Polygons are given by their
/// source numbers, sorted.
struct RepairReport {
  /// False: the polygons were a closed shell already, and nothing below was tried.
  bool was_needed = false;
  /// Polygons with the same rings as another one, either way round.
  std::vector<int> duplicates;
  /// Vertices of one polygon put into the edge of a neighbour on which they lie.
  int t_vertices = 0;
  /// Polygons cut where the edge of another one lies on them.
  int cut = 0;
  /// Polygons that were turned round to agree with their neighbours.
  int turned = 0;
  /// Edges of more than two polygons.
  int crowded_edges = 0;
  /// Polygons with the outside on both sides: roof overhangs, loose panes.
  std::vector<int> dangling;
  double dangling_area_m2 = 0;
  /// Polygons with material on both sides: partitions, the inner faces of boxes that stand in each
  /// other.
  std::vector<int> inner;
  double inner_area_m2 = 0;
  /// Faces made by oriel that bound the solid.
  std::vector<Cap> caps;
  /// Connected shells beside the one with the largest box that were kept as lumps of their own, and
  /// those kept as cavities.
  int detached_shells = 0;
  int cavities = 0;
  /// If the building stays open: the edges of one polygon, and how many loops they form at least.
  std::vector<OpenEdge> open_edges;
};

/// "planar" and so on, and back; nothing for another text.
std::string to_string(Closing closing);
std::string to_string(CapKind kind);
std::optional<Closing> parse_closing(std::string_view text);

}  // namespace oriel
