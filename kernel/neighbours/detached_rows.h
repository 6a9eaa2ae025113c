#pragma once

#include "kernel/neighbours/neighbours.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace oriel {

/// Detached buildings in a line, from one end to the other: positions in
/// NeighbourSearch::buildings().
using DetachedRow = std::vector<std::size_t>;

/// Rows of four buildings or more: each stands between the two beside it, at 15 degrees from
/// straight and a quarter from equal distances at most. Buildings beside each other are alike: the
/// ground of none is more than half as much again as that of the other, roofs differ by no more
/// than `like_height_m` in their mean height above the ground, and the middles of their grounds are
/// no further apart than three times the side of a square of that ground. A building is in one row
/// at most, the densest. Those that `is_candidate` says no to are passed over. By their first
/// members; a row begins with the lesser of its ends.
std::vector<DetachedRow> detached_rows(const NeighbourSearch& search, double like_height_m,
                                       const std::function<bool(std::size_t)>& is_candidate);

}  // namespace oriel
