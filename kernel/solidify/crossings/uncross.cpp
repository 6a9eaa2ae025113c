#include "kernel/solidify/crossings/uncross.h"

#include "kernel/base/index.h"
#include "kernel/solidify/crossings/crossings.h"
#include "kernel/solidify/mend/cells.h"
#include "kernel/solidify/mend/duplicates.h"
#include "kernel/solidify/mend/t_vertices.h"
#include "kernel/solidify/mend/windings.h"
#include "kernel/solidify/shells/edge_groups.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup_builder.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
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

/// As many polygons run one way along every edge as the other way.
bool is_cycle(const Soup& soup) {
  const ShellMesh mesh = linked_rings(soup);
  bool all_paired = !soup.polygons.empty();
  EdgeGroups(soup, mesh).for_each([&](EdgeGroup group) {
    const auto runs_up = [&](int h) {
      return soup.corners[at(h)] < soup.corners[at(mesh.next[at(h)])];
    };
    all_paired &= 2 * std::ranges::count_if(group, runs_up) == std::ssize(group);
  });
  return all_paired;
}

/// The soup with the polygons of every body turned round that encloses less than nothing.
Soup outward(const Soup& soup) {
  const std::vector<PolygonShape> shapes = shapes_of(soup);
  std::map<int, double> volume;  // by body
  for (int p = 0; p < soup.polygon_count(); ++p) {
    const Vec3 corner = exact::to_metres(soup.points[at(soup.corners_of(p).front())], 1) -
                        exact::to_metres(soup.points[0], 1);
    volume[soup.polygons[at(p)].body] += shapes[at(p)].area * dot(shapes[at(p)].unit, corner);
  }
  SoupBuilder builder(soup);
  for (int p = 0; p < soup.polygon_count(); ++p)
    builder.add_polygon(soup, p, volume.at(soup.polygons[at(p)].body) < 0);
  return builder.finish();
}

std::optional<Uncrossed> uncross_within(const Soup& soup, double reach, double weld) {
  auto [parted, cut] = cut_at_crossings(soup, reach, weld, RingKind::crossing);
  auto [joined, inserted] = insert_t_vertices(parted, weld, Inserted::all);
  const Soup pieces = without_opposites(joined);
  if (pieces.polygons.empty()) return std::nullopt;
  const std::vector<PolygonShape> shapes = shapes_of(pieces);
  const PolygonCells cells = find_cells(pieces, shapes);
  const auto windings = find_windings(pieces, cells);
  if (!windings) return std::nullopt;
  Uncrossed out;
  out.cut = cut;
  SoupBuilder builder(pieces);
  std::set<int> kept, all;
  for (const SoupPolygon& polygon : soup.polygons) all.insert(polygon.source);
  for (int p = 0; p < pieces.polygon_count(); ++p) {
    if ((*windings)[at(p)] != 0) continue;
    builder.add_polygon(pieces, p);
    kept.insert(pieces.polygons[at(p)].source);
  }
  std::ranges::set_difference(all, kept, std::back_inserter(out.left_out));
  const std::vector<PolygonShape> whole = shapes_of(soup);
  for (int p = 0; p < soup.polygon_count(); ++p)
    if (!kept.contains(soup.polygons[at(p)].source))
      out.left_out_m2 += whole[at(p)].area * soup.grid_m * soup.grid_m;
  out.soup = builder.finish();
  if (out.soup.polygons.empty()) return std::nullopt;
  return out;
}

}  // namespace

std::optional<Uncrossed> uncross(const Soup& soup, const Tolerances& tolerances) {
  if (!is_cycle(soup)) return std::nullopt;
  const Soup facing = outward(soup);
  const double reach = tolerances.plane_offset_m / soup.grid_m;
  const double weld = tolerances.weld_m / soup.grid_m;
  for (const auto& [on_plane, together] :
       {std::pair{reach, weld}, {reach / 10, weld}, {reach / 100, weld / 10}})
    if (auto uncrossed = uncross_within(facing, on_plane, together)) return uncrossed;
  return std::nullopt;
}

}  // namespace oriel::detail
