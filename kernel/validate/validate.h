#pragma once

#include "kernel/base/code.h"
#include "kernel/base/work.h"
#include "model/building.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// Tolerances and choices of validate(); the defaults are val3dity's.
struct ValidateOptions {
  /// Vertices closer than this are one vertex (val3dity: --snap_tol); whether those exactly so far
  /// apart are closer is decided as in val3dity by the doubles of their coordinates. At least 1e-6:
  /// all else is judged on whole micrometres of the building's frame.
  double snap_m = 0.001;
  /// How far a point of a polygon may lie from the plane fitted to all of them
  /// (--planarity_d2p_tol).
  double planarity_m = 0.01;
  /// How far the normals of a polygon's triangles may deviate (--planarity_n_tol).
  double planarity_deg = 20;
  /// What the polygons are judged as.
  enum class Primitive {
    /// What the input states: solids if Building::is_solid, else loose surfaces.
    as_stated,
    /// Solids; loose surfaces are then one shell.
    solid,
    /// Loose surfaces: rings and polygons only.
    surfaces
  };
  Primitive primitive = Primitive::as_stated;
  /// Whose findings are asked for.
  enum class Judge {
    /// val3dity's.
    val3dity,
    /// Those of any judge with these tolerances, whatever they leave open: vertices exactly
    /// `snap_m` apart may be one or two, and any two triangles of a polygon may be those that are
    /// compared (E345).
    any
  };
  Judge judge = Judge::val3dity;
  /// Pairs of edges and triangles, and corners, that may be looked at; then E502.
  std::int64_t budget = kWorkBudget;
};

/// Something wrong with the geometry of a building, and where.
struct Finding {
  /// oriel's code, with a section in docs/errors.md.
  Code code = Code::none;
  /// The number of val3dity's error that means the same, 0 if there is none.
  int val3dity = 0;
  /// What was found and what was expected, with the place, without code and building.
  std::string sentence;
  /// The solid, its shell (0 the exterior one), the polygon (Polygon::source) and its ring; -1
  /// where the finding is not of one.
  int body = -1;
  int shell = -1;
  int polygon = -1;
  int ring = -1;
  /// Where, in the input's coordinates: a point, the two ends of an edge, or nothing.
  std::vector<Vec3> at_m;
};

/// val3dity's name of an error ("NON_PLANAR_POLYGON_DISTANCE_PLANE"), or empty for 0 and numbers
/// that oriel does not use.
std::string_view val3dity_name(int number);

/// All that is wrong with the polygons of `building` as they were read, in the order of solids,
/// shells and polygons; nothing if it is valid. As val3dity does, the next level is judged only if
/// the one before has no error: the rings of a polygon (101, 102, 104), the polygon (201–208), the
/// shell (301–307) if all its polygons are good, the solid (401–405) if all its shells are, the
/// composite (501–503) if all its solids are. Loose surfaces are judged up to 208, a
/// CompositeSurface as a shell that may be open. Joined installations (Building::installations) are
/// not judged: they are no part of the building's geometry.
///
/// With Judge::any what is asked next is only asked if nothing was found.
///
/// Decided exactly on whole micrometres; only 203 and 204 measure in doubles. E506 and E501 for
/// coordinates that are not finite or a building of more than 4 km: then nothing else is judged.
/// Near linear in the number of polygons and of pairs whose boxes overlap; after
/// ValidateOptions::budget steps nothing more is judged, and a finding E502 comes last: what has it
/// is not known to be valid.
///
/// Source: Ledoux, On the validation of solids represented with the international standards for
/// geographic information (2013), and val3dity's documentation; differences: docs/validate.md.
std::vector<Finding> validate(const Building& building, const ValidateOptions& options = {});

/// A part of a building that overlaps another one.
struct PartOverlap {
  /// Its number among the parts.
  std::size_t part = 0;
  Finding finding;
};

/// Each pair of `parts` whose interiors have points in common (601), as a finding of the later one;
/// `parts` are of one building, solids without findings. Parts that share a face or lie in the
/// cavity of another one do not overlap. Exact as validate(); parts further than 4 km from the
/// first, and ones that are no solids next to each other, are passed over.
std::vector<PartOverlap> overlapping_parts(std::span<const Building* const> parts,
                                           const ValidateOptions& options = {});

}  // namespace oriel
