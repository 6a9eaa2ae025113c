#include "kernel/mesh/manifold.h"

#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace oriel::detail {

namespace {

/// A corner of a face, and the half-edge that leaves it.
using FaceCornerId = Id<struct FaceCornerTag>;

class FanSplitter {
 public:
  FanSplitter(std::span<const Vec3> points, std::span<const std::vector<int>> faces,
              std::span<const Vec3> normals)
      : points_(points),
        faces_(faces),
        normals_(normals),
        corners_(list_corners(faces, first_at_places(points))),
        fans_(corners_.size()),
        shells_(faces.size()) {}

  ManifoldFaces run() {
    link_all();
    for (int f = 0; f < static_cast<int>(faces_.size()); ++f) {
      const int first = shells_.find(f);
      out_.shell_of_face.push_back(first == f ? out_.shells++ : out_.shell_of_face[at(first)]);
    }
    double_vertices();
    return std::move(out_);
  }

 private:
  struct Corner {
    int face;
    /// The first point at its place.
    int place;
    /// The next corner of the face.
    FaceCornerId next;
    /// The place of that.
    int to;

    [[nodiscard]] bool is_forward() const { return place < to; }
    [[nodiscard]] std::pair<int, int> edge() const { return std::minmax({place, to}); }
  };

  /// For each point the first one at the same place.
  static std::vector<int> first_at_places(std::span<const Vec3> points) {
    const auto key = [&](int i) {
      return std::tuple(points[at(i)].x, points[at(i)].y, points[at(i)].z, i);
    };
    std::vector<int> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, key);
    std::vector<int> first(points.size());
    int leader = -1;
    for (const int i : order) {
      if (leader < 0 || points[at(leader)] != points[at(i)]) leader = i;
      first[at(i)] = leader;
    }
    return first;
  }

  static IndexedVector<FaceCornerId, Corner> list_corners(std::span<const std::vector<int>> faces,
                                                          const std::vector<int>& places) {
    IndexedVector<FaceCornerId, Corner> corners;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const int first = corners.next_id().value;
      const int count = static_cast<int>(faces[f].size());
      for (int i = 0; i < count; ++i) {
        const int j = (i + 1) % count;
        corners.push_back({static_cast<int>(f), places[at(faces[f][at(i)])],
                           FaceCornerId{first + j}, places[at(faces[f][at(j)])]});
      }
    }
    return corners;
  }

  /// Links the half-edges of every edge.
  void link_all() {
    std::vector<FaceCornerId> order;
    for (const FaceCornerId c : corners_.ids())
      if (corners_[c].place != corners_[c].to) order.push_back(c);
    std::ranges::sort(order, {}, [&](FaceCornerId c) { return std::pair(corners_[c].edge(), c); });
    for (std::size_t begin = 0; begin < order.size();) {
      std::size_t end = begin + 1;
      while (end < order.size() && corners_[order[end]].edge() == corners_[order[begin]].edge())
        ++end;
      link_edge({order.begin() + static_cast<std::ptrdiff_t>(begin),
                 order.begin() + static_cast<std::ptrdiff_t>(end)});
      begin = end;
    }
  }

  void link_edge(std::vector<FaceCornerId> half_edges) {
    const bool is_manifold = half_edges.size() == 1 ||
                             (half_edges.size() == 2 && corners_[half_edges[0]].is_forward() !=
                                                            corners_[half_edges[1]].is_forward());
    if (!is_manifold) {
      ++out_.non_manifold_edges;
      sort_around(half_edges);
    }
    std::size_t linked = 0;
    // From the first half-edge after one that is forward: no material spans the ends of the list.
    const std::size_t count = half_edges.size();
    std::size_t first = 0;
    while (first < count && !corners_[half_edges[first]].is_forward()) ++first;
    for (std::size_t i = 0; i < count && count > 1; ++i) {
      const FaceCornerId one = half_edges[(first + 1 + i) % count];
      const FaceCornerId other = half_edges[(first + 2 + i) % count];
      if (corners_[one].is_forward() || !corners_[other].is_forward()) continue;
      link(one, other);
      linked += 2;
    }
    out_.open_edges += static_cast<int>(count - linked);
  }

  /// Makes two half-edges of opposite directions one edge: their corners at either end are in one
  /// fan.
  void link(FaceCornerId c, FaceCornerId d) {
    fans_.unite(c.value, corners_[d].next.value);
    fans_.unite(d.value, corners_[c].next.value);
    shells_.unite(corners_[c].face, corners_[d].face);
  }

  /// Sorts the half-edges of an edge by the directions of their faces, counter-clockwise about it.
  void sort_around(std::vector<FaceCornerId>& half_edges) const {
    const auto [low, high] = corners_[half_edges[0]].edge();
    const Vec3 axis = normalised(points_[at(high)] - points_[at(low)]);
    const auto into_face = [&](FaceCornerId c) {
      const Corner& corner = corners_[c];
      return cross(normals_[at(corner.face)], corner.is_forward() ? axis : -axis);
    };
    const Vec3 zero = normalised(into_face(half_edges[0]));
    const Vec3 quarter = cross(axis, zero);
    const auto angle = [&](FaceCornerId c) {
      const Vec3 d = into_face(c);
      const double radians = std::atan2(dot(d, quarter), dot(d, zero));
      // Rounding must not put what lies in the first face's direction behind it.
      constexpr double kSame = 1e-12;  // tolerance of doubles
      return radians < -kSame ? radians + 2 * 3.14159265358979323846 : radians;
    };
    std::vector<std::pair<double, FaceCornerId>> order;
    for (const FaceCornerId c : half_edges) order.emplace_back(angle(c), c);
    std::ranges::sort(order);
    for (std::size_t i = 0; i < order.size(); ++i) half_edges[i] = order[i].second;
  }

  /// The first fan with a corner at a point keeps it.
  void double_vertices() {
    IndexedVector<FaceCornerId, int> vertex_of(corners_.size(), -1);
    std::vector<bool> is_taken(points_.size());
    int c = 0;
    for (const std::vector<int>& face : faces_) {
      std::vector<int> corners;
      for (const int v : face) {
        int& vertex = vertex_of[FaceCornerId{fans_.find(c++)}];
        if (vertex < 0 && is_taken[at(v)]) {
          vertex = static_cast<int>(points_.size() + out_.doubled.size());
          out_.doubled.push_back(v);
        }
        if (vertex < 0) {
          vertex = v;
          is_taken[at(v)] = true;
        }
        corners.push_back(vertex);
      }
      out_.corners.push_back(std::move(corners));
    }
  }

  std::span<const Vec3> points_;
  std::span<const std::vector<int>> faces_;
  std::span<const Vec3> normals_;
  IndexedVector<FaceCornerId, Corner> corners_;
  DisjointSets fans_;
  DisjointSets shells_;
  ManifoldFaces out_;
};

}  // namespace

ManifoldFaces make_manifold(std::span<const Vec3> points, std::span<const std::vector<int>> faces,
                            std::span<const Vec3> normals) {
  return FanSplitter(points, faces, normals).run();
}

}  // namespace oriel::detail
