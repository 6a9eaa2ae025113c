#pragma once

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
};

/// Facets that lean more than this from upright (the sine of 10 degrees) are no walls: where growth
/// is described, and where roofs are told from walls by it.
inline constexpr double kWallLean = 0.1736;

}  // namespace oriel
