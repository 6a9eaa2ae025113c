#pragma once

#include "generalise/operators/host.h"
#include "model/segmentation.h"
#include "model/solid.h"

#include <vector>

namespace oriel::detail {

/// Shifts, growths and gaps that are off by less are rounding: Tolerances::weld_m.
inline constexpr double kNoShift_m = 0.001;

/// A rectangle on a facade that may move: along it, or up and down together with its row.
struct Movable {
  Extents box{};
  int row = 0;            ///< rows are numbered from 0
  bool is_fixed = false;  ///< it stays, and the others keep off it
};

/// How far from each other and from what is fixed: the gap, and only if there is no room no nearer
/// than now; or the gap from those of Movable::is_fixed, and else no nearer than now, along the
/// wall.
enum class Apartness { gap, as_now };

/// Where the rectangles of a facade go, or why they have no room.
struct FacadePlaces {
  /// One for each; empty if there is no room.
  std::vector<Extents> places{};
  [[nodiscard]] bool has_room() const { return !places.empty(); }
  /// How near each comes to anything, no more than the gap.
  std::vector<double> clear_m{};
  /// Without room: the ones that crowd each other, ascending; by how much there is too little room
  /// for them, and the features that stand in their way.
  std::vector<std::size_t> crowded{};
  double lacking_m = 0;
  std::vector<FeatureId> beside{};
};

/// What is moved by no more than rounding is not moved.
bool is_moved(const Extents& now, const Extents& then);

/// Puts an opening of a wall back at a place that has been found on the facade, `clear_m` off
/// everything there (place_like). What is nearer lies behind the wall, such as a recess in the next
/// wall, around the corner: where that is so, half of the distance will do, down to an eighth.
Placed put_on_facade(const Solid& solid, const Segmentation& segmentation, const Host& host,
                     const Extents& where, double depth_m, double clear_m, const Feature& feature);

/// A facet as what moves on it sees it: the lines that it must keep off.
class FacadeRoom {
 public:
  /// One without lines.
  FacadeRoom() = default;
  /// `solid` and `segmentation` must stay. All edges of the facet, and the outlines of imprints
  /// that stay on it (place_like).
  FacadeRoom(const Solid& solid, const Segmentation& segmentation, const Host& host);

  /// The row of each rectangle: those whose heights overlap by half of the lower one's are in one.
  /// What stands on the foot of the wall is by itself: windows beside a door may go up.
  [[nodiscard]] std::vector<int> rows_of(const std::vector<Extents>& boxes) const;

  /// The features, ascending, whose lines are nearer to a rectangle than that.
  [[nodiscard]] std::vector<FeatureId> beside(const Extents& box, double distance_m) const;

  /// The places next to the present ones at which all rectangles are `gap_m` off each other and
  /// off what is fixed: those with the least sum of squared shifts (separate), first up and down,
  /// each row as a whole, then along the wall. Two things are kept apart in the direction in which
  /// they are further apart now, and in their order. What stands on the foot of the wall stays
  /// there. Where that leaves no room, those for which there is none need only come no
  /// nearer than they are to what is fixed.
  [[nodiscard]] FacadePlaces arrange(const std::vector<Movable>& movables, double gap_m,
                                     Apartness apartness = Apartness::gap) const;

 private:
  struct FacadeLine {
    double u0, v0, u1, v1;   ///< from and to; the facet lies to its left
    bool is_foot = false;    ///< something may stand on it
    FeatureId imprint{};     ///< whose outline it is
    int from = -1, to = -1;  ///< vertices of the solid, of an edge
  };
  friend class FacadeArranger;
  [[nodiscard]] static bool stands_on(const Extents& box, const FacadeLine& line);
  void add_outline(const Extents& box, FeatureId imprint);
  /// The feature that the line belongs to, or an invalid one: the body.
  [[nodiscard]] FeatureId owner(const FacadeLine& line) const;

  const Solid* solid_ = nullptr;
  const Segmentation* segmentation_ = nullptr;
  std::vector<FacadeLine> lines_;
};

}  // namespace oriel::detail
