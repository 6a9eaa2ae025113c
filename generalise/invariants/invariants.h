#pragma once

#include "generalise/needs.h"
#include "kernel/base/code.h"
#include "kernel/base/work.h"
#include "kernel/geometry/planar.h"
#include "model/building.h"
#include "model/cell_complex.h"
#include "model/plan.h"
#include "model/solid.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
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

/// Whether a solid is fit to be written.
enum class Fitness {
  unfit,
  as_it_came,  ///< not valid, but the building was not valid either
  valid
};

/// What changed that must not.
struct Violation {
  /// G411: of what stays something would hang in the air; G412: it would reach out of its box; else
  /// G405.
  Code code = Code::none;
  std::string sentence;  ///< "the footprint would change by 2.10 %"
};

/// Says how fit a solid is. That takes longer than cutting, and whoever writes checks anyway.
struct SolidValidator {
  std::function<Fitness(const Solid&)> fitness_of{};
  /// If given, what must not change that has: what would do that does not go as cells.
  std::function<std::optional<Violation>(const Solid&)> violation_of{};
  /// What is left after cuts is checked also if all of them went well.
  bool is_thorough = false;
  /// Features that went together before, ascending: they are tried first.
  std::vector<FeatureId> settled{};
  /// As Invariants::work.
  Work* work = nullptr;
  /// Keeps the cell complex of the segmentation from the first time that it is asked for, for all
  /// that is tried with it; null: nothing is kept.
  std::shared_ptr<std::optional<CellComplex>> complex{};
  /// Keeps what hinders operators, by feature, from the first time that they are refused; null: it
  /// is not looked for.
  std::shared_ptr<std::map<FeatureId, Hindrance>> hindrances{};

  explicit operator bool() const { return static_cast<bool>(fitness_of); }
};

/// What must not change by generalising.
struct Invariants {
  Limits limits{};
  /// Those of which no more may be lost or gained than the limits say.
  std::vector<PartyWall> party_walls{};
  /// No edge that is drawn may be shorter (short_edges_of_drawn), and none that tells of a piece
  /// torn off (new_short_edges); 0: it may.
  double least_edge_m = 0;
  /// Features that may go whatever edges that leaves. Ascending.
  std::vector<FeatureId> settled{};
  /// If given, what has no cut of its own goes as cells where that leaves what this calls fit
  /// (remove_cells).
  SolidValidator validator{};
  /// If given, what is done is counted in it; once it is used up nothing more is tried, and what
  /// was not carried out by then is refused (E502).
  Work* work = nullptr;
};

/// Why a feature stays for which there was no work left (E502).
inline constexpr const char* kNoWorkLeft = "the work budget is used up";

/// False also if no work is given.
inline bool is_used_up(const Work* work) { return work != nullptr && work->is_used_up(); }

/// Counts work on a solid, `steps` for each of its corners, in `work`, if that is given. False once
/// it is used up.
bool may_go_on(Work* work, const Solid& solid, std::int64_t steps);

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

/// A box that `before`, larger by `slack_m` on all sides, does not hold.
bool reaches_out(const Box& before, const Box& after, double slack_m);

Measures measures_of(const Solid& solid, const Invariants& invariants = {});

/// What changed that must not, or nothing. It must never fall into more pieces than it was. The
/// main ridge and the main eaves (main_height_m) change if less than half of their length is left
/// at their height, give or take the limit; a roof without ridge, as a pyramid, has none to lose.
std::optional<Violation> violation(const Measures& before, const Measures& after,
                                   const Invariants& invariants);

}  // namespace oriel
