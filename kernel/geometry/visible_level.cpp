#include "kernel/geometry/visible_level.h"

#include <algorithm>
#include <tuple>

namespace oriel::detail {

std::optional<double> visible_level(std::span<ParallelArea> areas, double outline_m2) {
  std::ranges::sort(areas, {},
                    [](const ParallelArea& a) { return std::tuple(-a.offset_m, a.area_m2); });
  std::optional<double> level;
  double covered_m2 = 0;
  for (const ParallelArea& area : areas) {
    level = area.offset_m;
    covered_m2 += area.area_m2;
    if (covered_m2 >= outline_m2 / 2) break;
  }
  return level;
}

}  // namespace oriel::detail
