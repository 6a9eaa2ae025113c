#pragma once

#include <optional>
#include <span>

namespace oriel::detail {

/// Something parallel to a plane: how far it lies before it (negative: behind it), and its area.
struct ParallelArea {
  double offset_m = 0;
  double area_m2 = 0;
};

/// The level, seen from before the plane, down to which parallel areas cover half of an outline of
/// `outline_m2`: that of the pane, not of a narrow frame before it or of what stands behind it. If
/// all together cover less, the level of the last of them; nothing if there are none. Sorts them.
std::optional<double> visible_level(std::span<ParallelArea> areas, double outline_m2);

}  // namespace oriel::detail
