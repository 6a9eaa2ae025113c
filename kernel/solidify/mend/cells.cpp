#include "kernel/solidify/mend/cells.h"

#include "kernel/base/index.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/solidify/mend/radial.h"
#include "kernel/solidify/shells/edge_groups.h"

namespace oriel::detail {

namespace {

/// The two sides of a polygon as numbers.
int front_of(int polygon) { return 2 * polygon; }
int back_of(int polygon) { return 2 * polygon + 1; }

/// Sides and pieces as they are united edge by edge.
class Uniter {
 public:
  Uniter(const Soup& soup, const std::vector<PolygonShape>& shapes)
      : soup_(soup),
        shapes_(shapes),
        mesh_(linked_rings(soup)),
        sides(2 * soup.polygons.size()),
        pieces(soup.polygons.size()) {}

  void run() {
    EdgeGroups(soup_, mesh_).for_each([&](EdgeGroup group) {
      for (const int h : group) pieces.unite(polygon(group[0]), polygon(h));
      unite_round(group);
    });
  }

 private:
  [[nodiscard]] int polygon(int h) const { return mesh_.polygon_of[at(h)]; }

  void unite_round(EdgeGroup group) {
    if (group.size() > 2) ++crowded_edges;
    std::vector<Spoke> spokes;
    if (group.size() > 2) {
      spokes = sort_round(soup_, mesh_, group, shapes_);
    } else {
      const int low =
          std::min(soup_.corners[at(group[0])], soup_.corners[at(mesh_.next[at(group[0])])]);
      for (const int h : group) spokes.push_back({h, soup_.corners[at(h)] == low});
    }
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      const Spoke &mine = spokes[i], &next = spokes[(i + 1) % spokes.size()];
      const int p = polygon(mine.half_edge), q = polygon(next.half_edge);
      sides.unite(mine.runs_up ? front_of(p) : back_of(p), next.runs_up ? back_of(q) : front_of(q));
    }
  }

  const Soup& soup_;
  const std::vector<PolygonShape>& shapes_;
  ShellMesh mesh_;

 public:
  DisjointSets sides, pieces;
  int crowded_edges = 0;
};

/// Six times the volume that a polygon adds to what is behind it, in grid units.
double volume_part(const Soup& soup, const PolygonShape& shape, int polygon) {
  const Vec3 corner = exact::to_metres(soup.points[at(soup.corners_of(polygon).front())], 1);
  const Vec3 base = exact::to_metres(soup.points[0], 1);
  return 2 * shape.area * dot(shape.unit, corner - base);
}

}  // namespace

PolygonCells find_cells(const Soup& soup, const std::vector<PolygonShape>& shapes) {
  Uniter uniter(soup, shapes);
  uniter.run();
  PolygonCells cells;
  cells.crowded_edges = uniter.crowded_edges;
  const int count = soup.polygon_count();
  std::vector<double> volume(2 * at(count), 0);
  Numbers number(at(count), -1);
  for (int p = 0; p < count; ++p) {
    cells.front.push_back(uniter.sides.find(front_of(p)));
    cells.back.push_back(uniter.sides.find(back_of(p)));
    int& piece = number[at(uniter.pieces.find(p))];
    if (piece < 0) piece = cells.piece_count++;
    cells.piece.push_back(piece);
    const double part = volume_part(soup, shapes[at(p)], p);
    volume[at(cells.back[at(p)])] += part;
    volume[at(cells.front[at(p)])] -= part;
  }
  cells.outer.assign(at(cells.piece_count), -1);
  for (int p = 0; p < count; ++p)
    for (const int cell : {cells.front[at(p)], cells.back[at(p)]}) {
      int& outer = cells.outer[at(cells.piece[at(p)])];
      if (outer < 0 || volume[at(cell)] < volume[at(outer)]) outer = cell;
    }
  return cells;
}

}  // namespace oriel::detail
