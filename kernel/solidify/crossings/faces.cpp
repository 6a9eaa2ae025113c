#include "kernel/solidify/crossings/faces.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

namespace oriel::detail {

namespace {

/// Walks the faces that half-edges make, the same way round every time.
class FaceWalk {
 public:
  FaceWalk(const Soup& soup, Vec3 normal, std::span<const PointPair> half_edges)
      : soup_(soup), normal_(normal), half_edges_(half_edges) {
    for (const auto& [from, to] : half_edges) ways_[from].push_back(to);
  }

  [[nodiscard]] Loops loops() const {
    Loops loops;
    std::set<PointPair> walked;
    for (const PointPair& start : half_edges_) {
      std::vector<int> loop;
      for (PointPair e = start; walked.insert(e).second;) {
        loop.push_back(e.first);
        e = {e.second, leftmost(e, ways_.at(e.second))};
      }
      if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
  }

 private:
  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }

  /// Of the ways on from the end of an edge the first clockwise from where it came from.
  [[nodiscard]] int leftmost(const PointPair& edge, std::span<const int> ways) const {
    const Vec3 back = normalised(place(edge.first) - place(edge.second));
    int best = -1;
    double least = 0;
    for (const int w : ways) {
      const Vec3 way = normalised(place(w) - place(edge.second));
      double angle = std::atan2(-dot(cross(back, way), normal_), dot(back, way));
      if (angle <= 0 || w == edge.first) angle += 2 * std::numbers::pi;
      if (best >= 0 && angle >= least) continue;
      best = w;
      least = angle;
    }
    return best;
  }

  const Soup& soup_;
  Vec3 normal_;
  std::span<const PointPair> half_edges_;
  std::map<int, std::vector<int>> ways_;  ///< by point where they lead
};

/// Every ring edge once, every other edge both ways.
std::vector<PointPair> half_edges_of(const CutPolygon& cut) {
  std::vector<PointPair> half_edges;
  for (const auto& ring : cut.rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      half_edges.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
  for (const auto& [low, high] : cut.edges) {
    half_edges.emplace_back(low, high);
    half_edges.emplace_back(high, low);
  }
  return half_edges;
}

}  // namespace

Faces::Faces(const Soup& soup, Vec3 normal, std::span<const PointPair> half_edges)
    : loops(FaceWalk(soup, normal, half_edges).loops()) {
  for (const auto& loop : loops) {
    outlines.emplace_back();
    for (const int v : loop) outlines.back().push_back(exact::to_metres(soup.points[at(v)], 1));
    areas.push_back(signed_area(outlines.back(), normal));
  }
  find_faces_around(normal);
}

void Faces::find_faces_around(Vec3 normal) {
  face_of.assign(loops.size(), -1);
  std::vector<Box> boxes(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (const Vec3 p : outlines[i]) boxes[i].grow(p);
  const BoxTree tree(boxes);
  for (std::size_t j = 0; j < loops.size(); ++j) {
    if (areas[j] >= 0) continue;
    const Vec3 start = outlines[j].front();
    tree.search([&](const Box& box) { return comes_near(box, start, start, 0); },
                [&](int i) {
                  const int best = face_of[j];
                  const auto rank = [&](int loop) { return std::pair(areas[at(loop)], loop); };
                  if (areas[at(i)] <= 0 || (best >= 0 && rank(best) <= rank(i))) return;
                  const auto& loop = loops[at(i)];
                  const bool is_own_side = std::ranges::find(loop, loops[j][0]) != loop.end();
                  if (!is_own_side && contains({&outlines[at(i)], 1}, normal, start))
                    face_of[j] = i;
                });
  }
}

std::vector<std::size_t> Faces::rings_of(std::size_t face) const {
  std::vector<std::size_t> rings{face};
  for (std::size_t j = 0; j < loops.size(); ++j)
    if (face_of[j] == static_cast<int>(face)) rings.push_back(j);
  return rings;
}

std::vector<std::vector<int>> rings_of(const Soup& soup, int polygon) {
  std::vector<std::vector<int>> rings;
  for (const int r : soup.rings_of(polygon)) {
    const auto ring = soup.ring(r);
    rings.emplace_back(ring.begin(), ring.end());
  }
  return rings;
}

bool add_faces(const Soup& soup, const PolygonShape& shape, const CutPolygon& cut, double slack,
               SoupBuilder& builder) {
  ORIEL_ASSERT(!cut.rings.empty());
  const Faces found(soup, shape.unit, half_edges_of(cut));
  const double sum = std::accumulate(found.areas.begin(), found.areas.end(), 0.0);
  const auto faces = std::ranges::count_if(found.areas, [](double area) { return area > 0; });
  builder.begin_polygon(soup.polygons[at(cut.polygon)]);
  if (faces <= 1 || std::abs(sum - shape.area) > slack) {
    for (const auto& ring : cut.rings) builder.add_ring(ring);
    return false;
  }
  for (std::size_t i = 0; i < found.loops.size(); ++i) {
    if (found.areas[i] <= 0) continue;
    builder.begin_polygon(soup.polygons[at(cut.polygon)]);
    for (const std::size_t j : found.rings_of(i)) builder.add_ring(found.loops[j]);
  }
  return true;
}

}  // namespace oriel::detail
