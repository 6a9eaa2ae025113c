#pragma once

#include "kernel/segment/boundary/boundary.h"

#include <optional>
#include <vector>

namespace oriel::detail {

/// What a sweep has seen of the sections at a plane: just behind it and just in front of it. If
/// such a section is one loop around material, and some edge crosses the plane between its ends (so
/// the loop does not follow edges all the way), then its area; else nothing.
struct PassedPlane {
  std::optional<double> behind_m2, in_front_m2;
};

/// Follows the contour of a body in a plane that moves along a normal class, from one plane of the
/// class to the next. Where a section is made anew for every plane, most of it is as it was at the
/// plane before; the sweep pays for what has changed. Areas are sums over edges, right to some
/// kSweptArea_m2.
///
/// Returns what was seen at each of `planes`, which are of the class and ascend. Where doubles do
/// not tell how the contour goes on, the rest of the planes stays without an answer.
std::vector<PassedPlane> sweep(const Boundary& body, int normal_class,
                               const std::vector<int>& planes);

inline constexpr double kSweptArea_m2 = 1e-4;  // far above rounding, far below a feature

}  // namespace oriel::detail
