#pragma once

#include "generalise/operators/host.h"
#include "kernel/model/segmentation.h"
#include "kernel/model/solid.h"

#include <vector>

namespace oriel::detail {

/// Shifts, growths and gaps that are off by less are rounding: Tolerances::weld_m.
inline constexpr double kNoShift_m = 0.001;

/// A rectangle on a facade that may move: along it, or up and down together with its row.
struct Movable {
  Extents box{};
  int row = 0;  ///< rows are numbered from 0
};

/// Where the rectangles of a facade go, or why they have no room.
struct FacadePlaces {
  /// One for each; empty if there is no room.
  std::vector<Extents> places{};
  /// How near each comes to anything, no more than the gap.
  std::vector<double> clear_m{};
  /// Without room: the ones that crowd each other, ascending; by how much there is too little room
  /// for them, and the features that stand in their way.
  std::vector<std::size_t> crowded{};
  double lacking_m = 0;
  std::vector<FeatureId> beside{};
};

/// A facet as what moves on it sees it: the lines that it must keep off.
class FacadeRoom {
 public:
  /// All edges of the facet, and the outlines of imprints that stay on it (place_like).
  FacadeRoom(const Solid& solid, const Segmentation& segmentation, const Host& host);

  /// The row of each rectangle: those whose heights overlap by half of the lower one's are in one.
  /// What stands on the foot of the wall is by itself: windows beside a door may go up.
  [[nodiscard]] std::vector<int> rows_of(const std::vector<Extents>& boxes) const;

  /// Something else that keeps its place.
  void add_fixed(const Extents& box, FeatureId owner);

  /// The places next to the present ones at which all rectangles are `gap_m` off each other and
  /// off what is fixed: those with the least sum of squared shifts (separate), first up and down,
  /// each row as a whole, then along the wall. Two things are kept apart in the direction in which
  /// they are further apart now, and in their order. What stands on the foot of the wall stays
  /// there. Where that leaves no room, those for which there is none need only come no
  /// nearer than they are to what is fixed.
  [[nodiscard]] FacadePlaces arrange(const std::vector<Movable>& movables, double gap_m) const;

 private:
  struct Line {
    double u0, v0, u1, v1;  ///< from and to; the facet lies to its left
    bool is_foot;           ///< something may stand on it
    FeatureId owner;
  };
  friend class FacadeArranger;
  [[nodiscard]] static bool stands_on(const Extents& box, const Line& line);

  std::vector<Line> lines_;
};

}  // namespace oriel::detail
