#include "kernel/solidify/detail/mend/faces.h"

#include "kernel/model/detail/index.h"
#include "kernel/solidify/detail/mend/box_tree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace oriel::detail {

namespace {

using Loops = std::vector<std::vector<int>>;

/// Walks the faces that rings and edges make: every ring edge once, every other edge both ways.
class FaceWalk {
 public:
  FaceWalk(const Soup& soup, Vec3 normal, const CutPolygon& cut) : soup_(soup), normal_(normal) {
    for (const auto& ring : cut.rings)
      for (std::size_t i = 0; i < ring.size(); ++i) add(ring[i], ring[(i + 1) % ring.size()]);
    for (const auto& [low, high] : cut.edges) {
      add(low, high);
      add(high, low);
    }
  }

  [[nodiscard]] Loops loops() const {
    Loops loops;
    std::set<Edge> walked;
    for (const Edge& start : half_edges_) {
      std::vector<int> loop;
      for (Edge e = start; walked.insert(e).second;) {
        loop.push_back(e.first);
        e = {e.second, leftmost(e, ways_.at(e.second))};
      }
      if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
  }

 private:
  void add(int from, int to) {
    ways_[from].push_back(to);
    half_edges_.emplace_back(from, to);
  }
  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }

  /// Of the ways on from the end of an edge the first clockwise from where it came from.
  [[nodiscard]] int leftmost(const Edge& edge, const std::vector<int>& ways) const {
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
  std::map<int, std::vector<int>> ways_;  ///< by point where they lead
  std::vector<Edge> half_edges_;
};

/// For every loop that runs clockwise the smallest face that it is a hole of, -1 for the others.
std::vector<int> faces_around(const Loops& loops, const std::vector<Outline>& outlines,
                              const std::vector<double>& areas, Vec3 normal) {
  std::vector<int> face_of(loops.size(), -1);
  std::vector<Box> boxes(loops.size());
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (const Vec3 p : outlines[i]) boxes[i].grow(p);
  for (std::size_t j = 0; j < loops.size(); ++j) {
    if (areas[j] >= 0) continue;
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const int best = face_of[j];
      if (areas[i] <= 0 || (best >= 0 && areas[at(best)] <= areas[i])) continue;
      if (!comes_near(boxes[i], outlines[j].front(), outlines[j].front(), 0)) continue;
      const bool is_own_side = std::ranges::find(loops[i], loops[j][0]) != loops[i].end();
      if (!is_own_side && contains({&outlines[i], 1}, normal, outlines[j].front()))
        face_of[j] = static_cast<int>(i);
    }
  }
  return face_of;
}

}  // namespace

std::vector<std::vector<int>> rings_of(const Soup& soup, int polygon) {
  std::vector<std::vector<int>> rings;
  for (const int r : soup.rings_of(polygon)) {
    const auto ring = soup.ring(r);
    rings.emplace_back(ring.begin(), ring.end());
  }
  return rings;
}

std::vector<Outline> outlines_of(const Soup& soup, int polygon) {
  std::vector<Outline> outlines;
  for (const int r : soup.rings_of(polygon)) {
    outlines.emplace_back();
    for (const int v : soup.ring(r))
      outlines.back().push_back(exact::to_metres(soup.points[at(v)], 1));
  }
  return outlines;
}

bool add_faces(const Soup& soup, const PolygonShape& shape, const CutPolygon& cut, double slack,
               SoupBuilder& builder) {
  const Loops loops = FaceWalk(soup, shape.unit, cut).loops();
  std::vector<Outline> outlines;
  std::vector<double> areas;
  double sum = 0;
  for (const auto& loop : loops) {
    outlines.emplace_back();
    for (const int v : loop) outlines.back().push_back(exact::to_metres(soup.points[at(v)], 1));
    areas.push_back(signed_area(outlines.back(), shape.unit));
    sum += areas.back();
  }
  const auto faces = std::ranges::count_if(areas, [](double area) { return area > 0; });
  builder.begin_polygon(soup.polygons[at(cut.polygon)]);
  if (faces <= 1 || std::abs(sum - shape.area) > slack) {
    for (const auto& ring : cut.rings) builder.add_ring(ring);
    return false;
  }
  const std::vector<int> face_of = faces_around(loops, outlines, areas, shape.unit);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (areas[i] <= 0) continue;
    builder.begin_polygon(soup.polygons[at(cut.polygon)]);
    builder.add_ring(loops[i]);
    for (std::size_t j = 0; j < loops.size(); ++j)
      if (face_of[j] == static_cast<int>(i)) builder.add_ring(loops[j]);
  }
  return true;
}

}  // namespace oriel::detail
