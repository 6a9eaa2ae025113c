#include "kernel/attach/convex_body.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cstddef>

namespace oriel::detail {

namespace {

/// False if four planes meet in a corner.
bool find_corners(const std::vector<Plane>& planes, ConvexBody& body) {
  const int count = static_cast<int>(planes.size());
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      for (int k = j + 1; k < count; ++k) {
        const auto point = exact::meet(planes[at(i)], planes[at(j)], planes[at(k)]);
        if (!point) continue;
        bool is_corner = true, is_crowded = false;
        for (int other = 0; other < count && is_corner; ++other) {
          if (other == i || other == j || other == k) continue;
          const int side = exact::side(planes[at(other)], *point);
          is_corner = side <= 0;
          is_crowded = is_crowded || side == 0;
        }
        if (!is_corner) continue;
        if (is_crowded) return false;
        body.corners.push_back({*point, {i, j, k}});
      }
  return true;
}

/// The corners of a facet in turn: neighbours share a second plane. Empty if they do not close.
Loop ring_of(const ConvexBody& body, int plane) {
  Loop all;
  for (int c = 0; c < std::ssize(body.corners); ++c)
    if (std::ranges::find(body.corners[at(c)].planes, plane) != body.corners[at(c)].planes.end())
      all.push_back(c);
  if (all.size() < 3) return {};
  Loop ring{all.front()};
  int across = -1;  // the plane along which the ring came
  while (true) {
    const auto& here = body.corners[at(ring.back())].planes;
    int next_across = -1, next = -1;
    for (const int p : here)
      if (p != plane && p != across) next_across = p;
    for (const int c : all)
      if (c != ring.back() && std::ranges::find(body.corners[at(c)].planes, next_across) !=
                                  body.corners[at(c)].planes.end())
        next = c;
    if (next < 0 || ring.size() > all.size()) return {};
    if (next == ring.front()) break;
    ring.push_back(next);
    across = next_across;
  }
  return ring.size() == all.size() ? ring : Loop{};
}

/// Counter-clockwise about the normal: the sign of one exact turn of a convex ring.
bool is_clockwise(const ConvexBody& body, const Loop& ring, const Plane& plane) {
  std::array<Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i)
    p.at(i) = exact::to_metres(body.corners[at(ring[i])].point, 1);
  return dot(cross(p[1] - p[0], p[2] - p[1]), plane.normal) < 0;
}

}  // namespace

std::optional<ConvexBody> convex_body(const std::vector<Plane>& planes) {
  ConvexBody body;
  if (!find_corners(planes, body) || body.corners.size() < 4) return std::nullopt;
  std::size_t sides = 0;
  for (int p = 0; p < std::ssize(planes); ++p) {
    Loop ring = ring_of(body, p);
    const bool touches = std::ranges::any_of(body.corners, [&](const auto& corner) {
      return std::ranges::find(corner.planes, p) != corner.planes.end();
    });
    if (ring.empty() && touches) return std::nullopt;
    if (!ring.empty() && is_clockwise(body, ring, planes[at(p)])) std::ranges::reverse(ring);
    sides += ring.size();
    body.loops.push_back(std::move(ring));
  }
  // Each corner has three facets, and by Euler a closed body has no other number of them.
  const auto facets = static_cast<std::size_t>(
      std::ranges::count_if(body.loops, [](const Loop& loop) { return !loop.empty(); }));
  if (sides != 3 * body.corners.size() || body.corners.size() + facets != sides / 2 + 2)
    return std::nullopt;
  return body;
}

}  // namespace oriel::detail
