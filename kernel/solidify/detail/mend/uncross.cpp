#include "kernel/solidify/detail/mend/uncross.h"

#include "kernel/model/detail/index.h"
#include "kernel/solidify/detail/mend/cells.h"
#include "kernel/solidify/detail/mend/crossings.h"
#include "kernel/solidify/detail/mend/duplicates.h"
#include "kernel/solidify/detail/mend/soup_builder.h"
#include "kernel/solidify/detail/mend/t_vertices.h"
#include "kernel/solidify/detail/mend/windings.h"
#include "kernel/solidify/detail/polygon_shape.h"

#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

Soup without_opposites(const Soup& soup) {
  const std::vector<char> is_opposite = find_opposites(soup);
  SoupBuilder builder(soup);
  for (int p = 0; p < soup.polygon_count(); ++p)
    if (!is_opposite[at(p)]) builder.add_polygon(soup, p);
  return builder.finish();
}

std::optional<Uncrossed> uncross_within(const Soup& soup, double reach, double weld) {
  auto [parted, cut] = cut_at_crossings(soup, reach, weld, RingKind::crossing);
  auto [joined, inserted] = insert_t_vertices(parted, weld, Inserted::all);
  const Soup pieces = without_opposites(joined);
  const std::vector<PolygonShape> shapes = shapes_of(pieces);
  const PolygonCells cells = find_cells(pieces, shapes);
  const auto windings = find_windings(pieces, cells);

  if (!windings) return std::nullopt;
  Uncrossed out;
  out.cut = cut;
  SoupBuilder builder(pieces);
  for (int p = 0; p < pieces.polygon_count(); ++p)
    if ((*windings)[at(p)] == 0) builder.add_polygon(pieces, p);
  out.soup = builder.finish();
  return out;
}

}  // namespace

std::optional<Uncrossed> uncross(const Soup& soup, const Tolerances& tolerances) {
  const double reach = tolerances.plane_offset_m / soup.grid_m;
  const double weld = tolerances.weld_m / soup.grid_m;
  for (const auto& [on_plane, together] :
       {std::pair{reach, weld}, {reach / 10, weld}, {reach / 100, weld / 10}})
    if (auto uncrossed = uncross_within(soup, on_plane, together)) return uncrossed;
  return std::nullopt;
}

}  // namespace oriel::detail
