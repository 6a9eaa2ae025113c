#include "kernel/solidify/supposed_solid.h"

#include "kernel/base/index.h"
#include "kernel/solidify/missing/fill.h"
#include "kernel/solidify/shells/solid_of_shells.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <utility>

namespace oriel {

namespace {

/// More is supposed than there is.
bool is_mostly_supposed(const Soup& soup) {
  double there = 0, supposed = 0;
  const auto shapes = detail::shapes_of(soup);
  for (int p = 0; p < soup.polygon_count(); ++p)
    (soup.polygons[at(p)].source == kNoSource ? supposed : there) += shapes[at(p)].area;
  return supposed > there;
}

}  // namespace

std::optional<SupposedSolid> supposed_solid(const Building& building, const Tolerances& tolerances,
                                            std::int64_t budget) {
  Work work(budget);
  Solidified out;
  const Soup soup = weld(building, tolerances, out.issues);
  if (soup.polygons.empty()) return std::nullopt;
  auto filled = detail::fill_missing_faces(soup, building.id, tolerances, work);
  if (!filled || is_mostly_supposed(filled->soup)) return std::nullopt;
  out.issues = std::move(filled->issues);  // those of welding solidify has reported
  detail::add_solid(building, filled->soup, filled->mesh, tolerances, out, work);
  if (!out.value || work.is_used_up()) return std::nullopt;
  return SupposedSolid{std::move(*out.value), std::move(filled->report.caps),
                       std::move(out.issues)};
}

}  // namespace oriel
