#include "generalise/invariants.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace oriel {

namespace {

constexpr double kGroundReach_m = 0.5;

double change_pct(double before, double after) {
  return before > 0 ? 100 * std::abs(after - before) / before : 0;
}

}  // namespace

Measures measures_of(const Solid& solid) {
  Measures out;
  for (const Shell& shell : solid.shells) out.lumps = std::max(out.lumps, shell.lump + 1);
  out.volume_m3 = volume_m3(solid);
  const Box box = box_of(solid);
  out.top_m = box.max.z;
  for (const Facet& facet : solid.facets) {
    const Plane& plane = solid.planes[facet.plane.index()];
    if (plane.coefficients[2] >= 0) continue;
    const bool is_low = std::ranges::all_of(facet.loops[0], [&](int v) {
      return solid.vertices[static_cast<std::size_t>(v)].point.z <= box.min.z + kGroundReach_m;
    });
    if (is_low) out.footprint_m2 -= plane.normal.z * area_m2(solid.vertices, facet, plane.normal);
  }
  return out;
}

std::optional<std::string> violation(const Measures& before, const Measures& after,
                                     const Invariants& invariants) {
  if (after.lumps > before.lumps) return "the building would fall apart";
  const double footprint = change_pct(before.footprint_m2, after.footprint_m2);
  if (invariants.footprint_pct && footprint > *invariants.footprint_pct)
    return fmt::format("the footprint would change by {:.2f} %", footprint);
  const double volume = change_pct(before.volume_m3, after.volume_m3);
  if (invariants.volume_pct && volume > *invariants.volume_pct)
    return fmt::format("the volume would change by {:.2f} %", volume);
  const double top_m = std::abs(after.top_m - before.top_m);
  if (invariants.top_m && top_m > *invariants.top_m)
    return fmt::format("its highest point would move by {:.2f} m", top_m);
  return std::nullopt;
}

}  // namespace oriel
