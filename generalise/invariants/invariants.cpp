#include "generalise/invariants/invariants.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace oriel {

namespace {

/// Planes that are fitted anew move by millimetres.
constexpr double kBoxSlack_m = 0.01;

double change_pct(double before, double after) {
  return before > 0 ? 100 * std::abs(after - before) / before : 0;
}

/// `what`: "the volume would change".
Violation beyond_limit(std::string_view what, double by, double limit, std::string_view unit) {
  return {Code::G405,
          fmt::format("{} by {:.3g} {}, more than {:g} {}", what, by, unit, limit, unit)};
}

/// Of the lines at their main height less than half is left there.
bool loses(const std::vector<LevelLine>& before, const std::vector<LevelLine>& after,
           double within_m) {
  const auto height_m = main_height_m(before);
  return height_m &&
         length_near_m(after, *height_m, within_m) < length_near_m(before, *height_m, within_m) / 2;
}

}  // namespace

bool reaches_out(const Box& before, const Box& after, double slack_m) {
  const Vec3 slack{slack_m, slack_m, slack_m};
  Box both{before.min - slack, before.max + slack};
  const Box grown = both;
  both.grow(after);
  return !(both == grown);
}

Measures measures_of(const Solid& solid, const Invariants& invariants) {
  Measures out;
  for (const Shell& shell : solid.shells) out.lumps = std::max(out.lumps, shell.lump + 1);
  out.volume_m3 = volume_m3(solid);
  const Box box = out.box = box_of(solid);
  for (const Facet& facet : solid.facets) {
    const Plane& plane = solid.planes[facet.plane.index()];
    if (plane.coefficients[2] >= 0) continue;
    const bool is_low = std::ranges::all_of(facet.loops[0], [&](int v) {
      return solid.vertices[static_cast<std::size_t>(v)].point.z <= box.min.z + kGroundReach_m;
    });
    (is_low ? out.footprint_m2 : out.overhang_m2) -=
        plane.normal.z * area_m2(solid.vertices, facet, plane.normal);
  }
  if (invariants.limits.ridge_m || invariants.limits.eaves_m) out.roof = roof_lines(solid);
  out.party_walls_m2 = shared_m2(solid, invariants.party_walls);
  return out;
}

std::optional<Violation> violation(const Measures& before, const Measures& after,
                                   const Invariants& invariants) {
  const Limits& limits = invariants.limits;
  if (after.lumps > before.lumps) return Violation{Code::G411, "the building would fall apart"};
  const double hanging_m2 = after.overhang_m2 - before.overhang_m2;
  if (limits.overhang_pct && hanging_m2 > *limits.overhang_pct / 100 * before.footprint_m2)
    return Violation{Code::G411, fmt::format("{:.2f} m2 would hang in the air", hanging_m2)};
  if (limits.overhang_pct && reaches_out(before.box, after.box, kBoxSlack_m))
    return Violation{Code::G412, "the building would reach further than it did"};
  const double footprint = change_pct(before.footprint_m2, after.footprint_m2);
  if (limits.footprint_pct && footprint > *limits.footprint_pct)
    return beyond_limit("the footprint would change", footprint, *limits.footprint_pct, "%");
  const double volume = change_pct(before.volume_m3, after.volume_m3);
  if (limits.volume_pct && volume > *limits.volume_pct)
    return beyond_limit("the volume would change", volume, *limits.volume_pct, "%");
  const double party_walls = change_pct(before.party_walls_m2, after.party_walls_m2);
  if (limits.party_walls_pct && party_walls > *limits.party_walls_pct)
    return beyond_limit("its party walls would change", party_walls, *limits.party_walls_pct, "%");
  const double top_m = std::abs(after.box.max.z - before.box.max.z);
  if (limits.top_m && top_m > *limits.top_m)
    return beyond_limit("its highest point would move", top_m, *limits.top_m, "m");
  if (limits.ridge_m && loses(before.roof.ridges, after.roof.ridges, *limits.ridge_m))
    return Violation{Code::G405,
                     fmt::format("its ridge would move by more than {} m", *limits.ridge_m)};
  if (limits.eaves_m && loses(before.roof.eaves, after.roof.eaves, *limits.eaves_m))
    return Violation{Code::G405,
                     fmt::format("its eaves would move by more than {} m", *limits.eaves_m)};
  return std::nullopt;
}

}  // namespace oriel
