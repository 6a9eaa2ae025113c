#pragma once

#include "kernel/base/code.h"
#include "kernel/geometry/planar.h"
#include "model/building.h"
#include "model/plan.h"
#include "model/solid.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// A level edge.
struct LevelLine {
  double height_m = 0;  ///< z in the frame
  double length_m = 0;
};

/// The level edges at which the facets of a roof begin and end: facets of no more than 75 degrees,
/// the default pack's steepest roof.
struct RoofLines {
  /// Between a facet that rises from there, or is level, and what is no roof: a wall, a verge.
  std::vector<LevelLine> eaves;
  /// Between facets of which one falls off from there and the other is a roof that falls off, too,
  /// or no roof.
  std::vector<LevelLine> ridges;
};

RoofLines roof_lines(const Solid& solid);

/// The height at which most of the length lies, to the centimetre; of equal ones the highest.
/// Nothing if there are no lines.
std::optional<double> main_height_m(const std::vector<LevelLine>& lines);

/// The length of lines no more than `within_m` above or below a height.
double length_near_m(const std::vector<LevelLine>& lines, double height_m, double within_m);

/// A wall of another building, in the frame of the building that it may stand against.
struct PartyWall {
  std::vector<Outline> outlines;  ///< the outer one first
  Vec3 normal;                    ///< out of the other building
};

/// The upright polygons of those of `buildings` with another id that a facet of `solid`, which is
/// `building`'s, lies against: it looks the opposite way, no more than a centimetre off, and they
/// overlap.
std::vector<PartyWall> party_walls(const Building& building, const Solid& solid,
                                   std::span<const Building> buildings);

/// The area of the solid's facets that lies against the walls.
double shared_m2(const Solid& solid, const std::vector<PartyWall>& walls);

/// What changed that must not.
struct Violation {
  /// G411: of what stays something would hang in the air; G412: it would reach out of its box; else
  /// G405.
  Code code = Code::none;
  std::string sentence;  ///< "the footprint would change by 2.10 %"
};

/// What must not change by generalising.
struct Invariants {
  Limits limits{};
  /// Those of which no more may be lost or gained than the limits say.
  std::vector<PartyWall> party_walls{};
  /// No edge that is drawn may be shorter (short_edges_of_drawn), and none that tells of a piece
  /// torn off (new_short_edges); 0: it may.
  double least_edge_m = 0;
};

/// Facets that look down are ground if they lie no higher than this over the lowest point.
inline constexpr double kGroundReach_m = 0.5;

/// What invariants look at.
struct Measures {
  int lumps = 0;
  double volume_m3 = 0;
  /// The area of facets that look down and lie within half a metre of the lowest point, as seen
  /// from above.
  double footprint_m2 = 0;
  /// The area of all other facets that look down, as seen from above.
  double overhang_m2 = 0;
  Box box;
  /// What Invariants ask for only.
  RoofLines roof{};
  double party_walls_m2 = 0;
};

Measures measures_of(const Solid& solid, const Invariants& invariants = {});

/// One thing that must not change: what is violated between before and after, or nothing.
struct Invariant {
  std::string_view name;
  std::optional<Violation> (*violation)(const Measures& before, const Measures& after,
                                        const Limits& limits);
};

/// All of them, in the order in which they are asked:
///
/// - pieces: it never falls into more than it was (G411)
/// - overhang: what hangs in the air that did not (G411)
/// - box: it reaches no further than it did, by more than `kBoxSlack_m` (G412)
/// - footprint, volume, party walls, top: by no more than the limit (G405)
/// - ridge, eaves: the main one (main_height_m) changes if less than half of its length is left at
///   its height, give or take the limit (G405); a roof without ridge, as a pyramid, has none to
///   lose
std::span<const Invariant> all_invariants();

/// The first of them that is violated.
std::optional<Violation> violation(const Measures& before, const Measures& after,
                                   const Invariants& invariants);

/// The violation G411 of what falls into more pieces than it was.
Violation fallen_apart();
std::optional<Violation> falls_apart(const Measures& before, const Measures& after);

/// The violation G412 of what reaches out of its box by more than `slack_m`.
std::optional<Violation> reaches_out(const Measures& before, const Measures& after, double slack_m);

/// Planes that are fitted anew move by millimetres.
inline constexpr double kBoxSlack_m = 0.01;

}  // namespace oriel
