#pragma once

#include "kernel/base/ids.h"
#include "model/vec3.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace oriel {

/// An oriented plane, exact on the grid of its solid: a point (x, y, z) in grid units is on it if
/// coefficients · (x, y, z) = offset. The integer normal points out of the solid, |component| ≤
/// 2^28, and its components have no common divisor. Parallel planes of one solid have equal or
/// negated coefficients.
struct Plane {
  std::array<std::int64_t, 3> coefficients{};
  std::int64_t offset = 0;
  /// The same plane in doubles: unit normal, and distance of the plane from the frame's origin
  /// along it.
  Vec3 normal;
  double offset_m = 0;
};

/// A vertex in metres of the frame.
struct Vertex {
  Vec3 point;
  /// True: the vertex is the meeting of the three planes of its facets, `point` its nearest double.
  /// False: `point` is exact (a grid point) and lies on the planes of its facets by decree (more
  /// than three planes meet, or they meet in no good point).
  bool is_meeting = false;
};

/// A closed cycle of vertices (indices), the facet's interior to its left seen from outside.
using Loop = std::vector<int>;

/// A maximal connected coplanar piece of a shell: one outer loop (counter-clockwise seen from
/// outside) first, then the loops of its holes (clockwise).
struct Facet {
  PlaneId plane;
  std::vector<Loop> loops;
  /// Input polygons that make up the facet (Polygon::source), sorted. Empty for facets made by
  /// oriel.
  std::vector<int> polygons;
};

/// A connected closed surface. A lump is one outer shell and the cavities inside it.
struct Shell {
  std::vector<FacetId> facets;
  /// Lumps count from 0; the shells of one lump share the number.
  int lump = 0;
  bool is_cavity = false;
};

/// A closed oriented body with planar facets: every edge of a loop is met by exactly one opposite
/// edge of another (or the same) facet of the same shell.
struct Solid {
  /// Metres per grid unit, a power of two.
  double grid_m = 0;
  std::vector<Plane> planes;
  std::vector<Vertex> vertices;
  std::vector<Facet> facets;
  std::vector<Shell> shells;
};

/// The area of a loop on a plane with unit normal `normal`, in m²: positive if counter-clockwise
/// about it.
double signed_area_m2(std::span<const Vertex> vertices, const Loop& loop, Vec3 normal);

/// The area of a facet without its holes, in m²; `normal` is its plane's.
double area_m2(std::span<const Vertex> vertices, const Facet& facet, Vec3 normal);

/// The volume in m³: a third of the sum of plane offset × facet area, which splitting a facet or
/// adding a pair of opposite caps leaves unchanged up to rounding.
double volume_m3(const Solid& solid);

/// The area of all facets in m².
double surface_m2(const Solid& solid);

/// The box of all vertices in use by a facet.
Box box_of(const Solid& solid);

/// True if every edge is met by exactly one opposite edge.
bool is_closed(const Solid& solid);

}  // namespace oriel
