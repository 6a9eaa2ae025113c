#pragma once

#include "kernel/base/work.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/complex/vertex_pool.h"
#include "model/vec3.h"

#include <cmath>
#include <utility>
#include <vector>

namespace oriel {

/// A directed piece of an outline in one plane. To its left, seen from the plane's front, `label`
/// begins to hold `count` times more.
struct Chord {
  int from = -1;
  int to = -1;
  int label = -1;
  int count = 1;
};

/// Labels say where a cell is: just in front of the plane, or just behind it.
constexpr int label_of(int cell, bool is_in_front) { return 2 * cell + (is_in_front ? 1 : 0); }
constexpr int cell_of(int label) { return label / 2; }
constexpr bool is_in_front(int label) { return label % 2 != 0; }

/// A point in a plane.
struct Vec2 {
  double x = 0, y = 0;

  friend constexpr Vec2 operator-(Vec2 p, Vec2 q) { return {p.x - q.x, p.y - q.y}; }
};

constexpr double dot(Vec2 p, Vec2 q) { return p.x * q.x + p.y * q.y; }
constexpr double cross(Vec2 p, Vec2 q) { return p.x * q.y - p.y * q.x; }
inline double length(Vec2 p) { return std::sqrt(dot(p, p)); }

/// Coordinates in a plane, counter-clockwise as seen from its front.
class PlaneAxes {
 public:
  explicit PlaneAxes(Vec3 normal) : axes_(axes_in(normal)) {}

  [[nodiscard]] Vec2 operator()(Vec3 point) const {
    return {dot(axes_.u, point), dot(axes_.v, point)};
  }

 private:
  ReachAxes axes_;
};

/// An undirected edge, a < b. Its windings say for each label how many times more it holds to the
/// left of a → b than to the right; none is 0, and there is one at least.
struct PlanarEdge {
  int a = -1;
  int b = -1;
  std::vector<std::pair<int, int>> windings;
};

/// Cuts the chords of one plane until no two edges cross, overlap or pass nearer to a vertex than
/// half the pool's reach: then what is left and right of an edge is certain in doubles. Where
/// chords cross the pool gets a vertex, unless one is within reach.
///
/// Ends: a chord is only ever replaced by shorter ones, and a vertex is made only where none is
/// within reach, so that there are no more lengths than pairs of vertices. Chords that cross at
/// their ends, where the vertex within reach does not shorten both, stay whole. What closed
/// outlines were before are closed outlines after. Returns no edge once `work` is used up.
std::vector<PlanarEdge> refine(std::vector<Chord> chords, const PlaneAxes& axes, VertexPool& pool,
                               Work& work);

}  // namespace oriel
