#pragma once

#include <algorithm>

namespace oriel {

/// The only tolerances of the kernel, one value passed to every stage. Everything else is decided
/// exactly on the planes and vertices that these make (docs/solidify.md, docs/segmentation.md).
struct Tolerances {
  /// Two polygons may share a plane if their normals differ by no more than this. 0.5° is what
  /// surveyed LoD3 walls show between panes of one facade.
  double coplanar_deg = 0.5;
  /// …and if no vertex of the polygon lies further from that plane than this. 1.5–2 × the noise
  /// of the input works best (docs/solidify.md, "Noise"); 2 mm suits models written in millimetres.
  double plane_offset_m = 0.002;
  /// Vertices closer than this are one vertex. The grid that coordinates are rounded to is the
  /// largest power of two ≤ weld_m / 1024, so rounding is far below it.
  double weld_m = 0.001;
  /// Features of one set of planes whose values differ by no more than this fraction form one node
  /// of the tree, and a value counts as below 1 only if it is below 1 − value_rel. Noise of 1 mm
  /// moves values by less.
  double value_rel = 0.01;

  /// Values, or volumes, that differ by no more than this fraction are the same but for the grid:
  /// what a corner that was put on it may move of the area of something a hundred times weld_m wide
  /// (few parts are thinner), about 1e-5. On exact input, where value_rel is nothing, 1e-9: the
  /// same number computed twice in doubles.
  [[nodiscard]] double tie_rel(double grid_m) const {
    return std::max(1e-9, std::min(value_rel, grid_m / (100 * weld_m)));
  }
};

/// Facets that lean more than this from upright (the sine of 10 degrees) are no walls: where growth
/// is described, and where roofs are told from walls by it.
inline constexpr double kWallLean = 0.1736;

/// Openings and facades are in facets steeper than 60 degrees: the z of their normals is less.
inline constexpr double kSteepNormal = 0.5;

/// What stands out no further than this before a wall is of its facade: plinths, frames and panels
/// stand out 2 to 12 cm.
inline constexpr double kFacadeDepth_m = 0.12;

/// How far walls of two buildings may be from each other to be a party wall, and how far they may
/// lean or be turned (the sine): they come to the millimetre. Walls that share less area meet along
/// an edge only.
inline constexpr double kPartyWall_m = 0.01;
inline constexpr double kPartyWallLean = 0.01;
inline constexpr double kPartyWall_m2 = 1e-4;

/// Buildings whose walls come as near as this touch (kernel/neighbours): models of neighbours that
/// were measured apart differ by centimetres, while the thinnest wall that could stand between two
/// walls, half a brick, is 10 cm (102.5 mm, BS 4729). They touch if they share this area or more,
/// about a door's leaf in a crack of 5 cm; less is a corner, or noise.
inline constexpr double kContact_m = 0.05;
inline constexpr double kContact_m2 = 0.1;

/// Grids that files have their coordinates on: whole millimetres, or micrometres. A coordinate is
/// on one if it is off by no more than this share of it, which doubles of 4 km are by far.
inline constexpr double kMillimetreGrid_m = 1e-3, kMicrometreGrid_m = 1e-6;
inline constexpr double kOffGrid = 1e-3;

/// An edge runs along the depth of a recess up to this angle (the sine): a millimetre a metre, as
/// much as welding moves an end.
inline constexpr double kDepthLean = 1e-3;

}  // namespace oriel
