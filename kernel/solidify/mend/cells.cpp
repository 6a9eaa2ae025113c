#include "kernel/solidify/mend/cells.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/solidify/shells/edge_groups.h"
#include "kernel/solidify/soup/polygon_shape.h"

#include <algorithm>
#include <span>
#include <vector>

namespace oriel::detail {

namespace {

/// A half-edge of an edge group as seen along the edge.
struct Spoke {
  int half_edge = -1;
  /// It runs from the smaller point to the larger one: going round the edge counter-clockwise (the
  /// larger point towards the eye), the polygon's front comes behind it.
  bool runs_up = false;
};

using exact::GridPoint;
using exact::Int128;

int sign(Int128 value) { return (value > 0) - (value < 0); }

IntegerNormal negated(const IntegerNormal& n) { return {-n[0], -n[1], -n[2]}; }

/// (m × n) · axis, and (m · n)(axis · axis) − (m · axis)(n · axis): sine and cosine of the angle
/// from m to n round the axis, times the same positive number. Below 2^92 and 2^127.
Int128 sine(const IntegerNormal& m, const IntegerNormal& n, const GridPoint& axis) {
  return Int128{m[1] * n[2] - m[2] * n[1]} * axis[0] + Int128{m[2] * n[0] - m[0] * n[2]} * axis[1] +
         Int128{m[0] * n[1] - m[1] * n[0]} * axis[2];
}

Int128 cosine(const IntegerNormal& m, const IntegerNormal& n, const GridPoint& axis) {
  const std::int64_t mn = m[0] * n[0] + m[1] * n[1] + m[2] * n[2];
  return mn * exact::dot({axis[0], axis[1], axis[2]}, axis) -
         exact::dot(m, axis) * exact::dot(n, axis);
}

struct SpokeDirection {
  Spoke spoke;
  IntegerNormal
      normal;    ///< that a half-edge that runs up would have: it follows the ray round the edge
  int half = 0;  ///< 0: at an angle in [0, π) to the first ray, 1: in [π, 2π)
  int rank = 0;  ///< among rays of the same direction
};

/// The half-edges of one edge counter-clockwise round it, by where their polygons lie. Decided
/// exactly on the polygons' integer normals. Of polygons that lie the same way, those in front (as
/// seen from the side that the lexicographically larger one of their normals points to) come in the
/// order of their numbers whichever edge is looked at, so that the order of two such polygons is
/// the same at all their edges. Polygons without area count as lying along the first one.
std::vector<Spoke> sort_round(const Soup& soup, const ShellMesh& mesh, const EdgeGroup& group,
                              std::span<const PolygonShape> shapes) {
  const std::size_t first = at(group[0]);
  const EdgeEnds ends(soup.corners[first], soup.corners[at(mesh.next[first])]);
  const auto &low = soup.points[at(ends.low)], &high = soup.points[at(ends.high)];
  const GridPoint axis{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  std::vector<SpokeDirection> rays;
  for (const int h : group) {
    const bool runs_up = soup.corners[at(h)] == ends.low;
    const int polygon = mesh.polygon_of[at(h)];
    const auto& own = shapes[at(polygon)].normal;
    const IntegerNormal normal = !own      ? rays.empty() ? IntegerNormal{} : rays[0].normal
                                 : runs_up ? *own
                                           : negated(*own);
    // Behind its like if it shows the larger of its two normals, before it if not.
    const bool is_larger = normal > negated(normal);
    rays.push_back({{h, runs_up}, normal, 0, is_larger ? polygon : -polygon});
  }
  const IntegerNormal zero = rays[0].normal;
  for (SpokeDirection& ray : rays) {
    const int s = sign(sine(zero, ray.normal, axis));
    ray.half = s > 0 || (s == 0 && cosine(zero, ray.normal, axis) >= 0) ? 0 : 1;
  }
  std::ranges::sort(rays, [&](const SpokeDirection& p, const SpokeDirection& q) {
    if (p.half != q.half) return p.half < q.half;
    const int s = sign(sine(p.normal, q.normal, axis));
    if (s != 0) return s > 0;
    return p.rank != q.rank ? p.rank < q.rank : p.spoke.half_edge < q.spoke.half_edge;
  });
  std::vector<Spoke> spokes;
  for (const SpokeDirection& ray : rays) spokes.push_back(ray.spoke);
  return spokes;
}

/// The two sides of a polygon as numbers.
int front_of(int polygon) { return 2 * polygon; }
int back_of(int polygon) { return 2 * polygon + 1; }

/// Sides and pieces as they are united edge by edge.
class Uniter {
 public:
  Uniter(const Soup& soup, std::span<const PolygonShape> shapes)
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
  std::span<const PolygonShape> shapes_;
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

PolygonCells find_cells(const Soup& soup, std::span<const PolygonShape> shapes) {
  ORIEL_ASSERT(shapes.size() == soup.polygons.size());
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
