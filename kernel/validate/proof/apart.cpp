#include "kernel/validate/proof/apart.h"

#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/validate/polygons/polygon_checks.h"
#include "kernel/validate/solids/triangle_pairs.h"
#include "kernel/validate/solids/triangle_plane.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <span>
#include <utility>

namespace oriel::detail {

namespace {

/// So many steps for each corner are taken before the proof is given up: valid buildings need some
/// dozens.
constexpr std::int64_t kStepsPerCorner = 512;

/// The corners of patches by vertex.
class CornersAt {
 public:
  CornersAt(const Patches& patches, std::size_t vertices)
      : first_(vertices + 1, 0), corners_(patches.corners.size()) {
    for (const PatchCorner& corner : patches.corners) ++first_[at(corner.vertex) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (const PatchCornerId c : patches.corners.ids())
      corners_[at(next[at(patches.corners[c].vertex)]++)] = c;
  }

  [[nodiscard]] std::span<const PatchCornerId> operator[](int vertex) const {
    return std::span(corners_).subspan(at(first_[at(vertex)]),
                                       at(first_[at(vertex) + 1] - first_[at(vertex)]));
  }

 private:
  std::vector<int> first_;  ///< by vertex
  std::vector<PatchCornerId> corners_;
};

class ApartProof {
 public:
  ApartProof(const SnappedBuilding& building, const ValidateOptions& options,
             const Patches& patches, const PatchCorners& twins)
      : building_(building),
        options_(options),
        patches_(patches.patches),
        corners_(patches.corners),
        twins_(twins),
        corners_at_(patches, building.points.size()),
        tree_({}),
        places_(building.points.size()),
        common_(patches.patches.size(), 0),
        steps_left_(kStepsPerCorner * std::ssize(corners_)) {
    std::vector<Box> boxes;
    for (const PatchCornerId c : corners_.ids()) {
      if (twins_[c] < c) continue;
      edges_.push_back(c);
      boxes.push_back(box_of(std::array{point(from(c)), point(to(c))}));
    }
    tree_ = BoxTree(std::move(boxes));
  }

  bool run() {
    for (const PatchId p : patches_.ids())
      if (may_fold_back(p) || !note_common_corners(p) || !is_apart_from_edges(p)) return false;
    std::ranges::sort(doubtful_);
    const auto doubles = std::ranges::unique(doubtful_);
    doubtful_.erase(doubles.begin(), doubles.end());
    return std::ranges::all_of(
        doubtful_, [&](const auto& pair) { return are_apart(pair.first, pair.second); });
  }

 private:
  /// Where a vertex lies to the patch that is looked at.
  struct VertexPlace {
    PatchId patch = {};
    int side = 0;  ///< of its plane; 0: in it
    bool is_corner = false;
  };

  [[nodiscard]] const MicrometrePoint& point(int vertex) const { return building_.point(vertex); }
  [[nodiscard]] int from(PatchCornerId corner) const { return corners_[corner].vertex; }
  [[nodiscard]] int to(PatchCornerId corner) const { return from(corners_[corner].next); }
  [[nodiscard]] PatchId patch_of(PatchCornerId corner) const { return corners_[corner].patch; }
  [[nodiscard]] bool are_of_one_polygon(PatchId p, PatchId q) const {
    return patches_[p].polygon == patches_[q].polygon;
  }
  bool may_go_on(std::int64_t steps) { return (steps_left_ -= steps) > 0; }

  /// A patch and one beside it are in one plane and look opposite ways: they lie on each other.
  [[nodiscard]] bool may_fold_back(PatchId p) const {
    const MicrometreTriangle its = points_of(building_, patches_[p].turn);
    const TrianglePlane plane(its);
    const auto is_in_plane = [&](int vertex) {
      return plane.side_of(point(vertex)) == 0 &&
             side_of(its[0], its[1], its[2], point(vertex)) == 0;
    };
    for (const PatchCornerId c : patches_[p].corners()) {
      const PatchId q = patch_of(twins_[c]);
      const TriangleCorners& other = patches_[q].turn;
      if (q < p || are_of_one_polygon(p, q) || !std::ranges::all_of(other, is_in_plane)) continue;
      const std::size_t axis = main_axis(its);
      const auto turns = [&](const MicrometreTriangle& t) {
        return turn(flattened(t[0], axis, true), flattened(t[1], axis, true),
                    flattened(t[2], axis, true));
      };
      if (turns(its) != turns(points_of(building_, other))) return true;
    }
    return false;
  }

  /// Patches that have corners in common which no common edges join are in doubt. False if too much
  /// has to be looked at.
  bool note_common_corners(PatchId p) {
    std::vector<PatchId> met;
    const PlanePatch& patch = patches_[p];
    for (const PatchCornerId c : patch.corners()) {
      const auto others = corners_at_[from(c)];
      if (!may_go_on(std::ssize(others))) return false;
      for (const PatchCornerId other : others)
        if (const PatchId q = patch_of(other); q > p && common_[q]++ == 0) met.push_back(q);
    }
    for (const PatchCornerId c : patch.corners())
      if (const PatchId q = patch_of(twins_[c]); q > p) --common_[q];
    for (const PatchId q : met)
      if (std::exchange(common_[q], 0) > 1) doubt(p, q);
    return true;
  }

  void doubt(PatchId p, PatchId q) {
    if (!are_of_one_polygon(p, q)) doubtful_.emplace_back(std::min(p, q), std::max(p, q));
  }

  bool is_apart_from_edges(PatchId p) {
    const PlanePatch& patch = patches_[p];
    for (const PatchCornerId c : patch.corners()) places_[at(from(c))] = {p, 0, true};
    const TrianglePlane plane(points_of(building_, patch.turn));
    bool is_good = true;
    tree_.search([&](const Box& box) { return is_good && overlap(box, patch.box); },
                 [&](int edge) { is_good = may_go_on(1) && is_clear(edges_[at(edge)], p, plane); });
    return is_good;
  }

  const VertexPlace& place_of(int vertex, PatchId p, const TrianglePlane& plane) {
    VertexPlace& place = places_[at(vertex)];
    if (place.patch == p) return place;
    int side = plane.side_of(point(vertex));
    if (side == 0) {
      const auto [a, b, c] = points_of(building_, patches_[p].turn);
      side = side_of(a, b, c, point(vertex));
    }
    return place = {p, side, false};
  }

  /// The edge has nothing in common with the patch but a corner, or the pair is in doubt.
  bool is_clear(PatchCornerId edge, PatchId p, const TrianglePlane& plane) {
    const PatchId one = patch_of(edge), other = patch_of(twins_[edge]);
    if (one == p || other == p || (are_of_one_polygon(one, p) && are_of_one_polygon(other, p)))
      return true;
    const VertexPlace &a = place_of(from(edge), p, plane), &b = place_of(to(edge), p, plane);
    if (a.side != 0 && a.side == b.side) return true;
    if (a.side == 0 && b.side == 0 && (a.is_corner || b.is_corner)) {
      doubt(one, p);
      doubt(other, p);
      return true;
    }
    if ((a.is_corner && b.side != 0) || (b.is_corner && a.side != 0)) return true;
    const Box box = box_of(std::array{point(from(edge)), point(to(edge))});
    const auto& triangles = triangles_of(p);
    return may_go_on(std::ssize(triangles)) &&
           std::ranges::none_of(triangles, [&](const TriangleCorners& corners) {
             const MicrometreTriangle triangle = points_of(building_, corners);
             return overlap(box, box_of(triangle)) &&
                    meets(point(from(edge)), point(to(edge)), triangle);
           });
  }

  const std::vector<TriangleCorners>& triangles_of(PatchId p) {
    const auto [entry, is_new] = triangles_.try_emplace(p);
    if (!is_new) return entry->second;
    const PlanePatch& patch = patches_[p];
    if (patch.end.value - patch.first.value == 3) {
      entry->second = {patch.turn};
    } else {
      FindingList findings(building_, options_.budget);
      entry->second =
          judge(building_, building_.polygons[patch.polygon], options_, findings).triangles;
    }
    return entry->second;
  }

  /// By all triangles. False also if two have an edge in common that is none of both patches.
  bool are_apart(PatchId p, PatchId q) {
    const auto &mine = triangles_of(p), &theirs = triangles_of(q);
    if (!may_go_on(std::ssize(mine) * std::ssize(theirs))) return false;
    for (const TriangleCorners& one : mine)
      for (const TriangleCorners& other : theirs) {
        if (!overlap(box_of(points_of(building_, one)), box_of(points_of(building_, other))))
          continue;
        TriangleCorners shared{};
        const auto end = std::ranges::copy_if(one, shared.begin(), [&](int v) {
                           return std::ranges::find(other, v) != other.end();
                         }).out;
        if (end - shared.begin() == 2 && !are_joined(p, q, shared[0], shared[1])) return false;
        if (intersect(building_, one, other)) return false;
      }
    return true;
  }

  [[nodiscard]] bool are_joined(PatchId p, PatchId q, int u, int v) const {
    const auto runs = [&](int start, int end) {
      return std::ranges::any_of(corners_at_[start], [&](PatchCornerId c) {
        return patch_of(c) == p && to(c) == end && patch_of(twins_[c]) == q;
      });
    };
    return runs(u, v) || runs(v, u);
  }

  const SnappedBuilding& building_;
  const ValidateOptions& options_;
  const IndexedVector<PatchId, PlanePatch>& patches_;
  const IndexedVector<PatchCornerId, PatchCorner>& corners_;
  const PatchCorners& twins_;
  CornersAt corners_at_;
  std::vector<PatchCornerId> edges_;    ///< corners that they begin at, once each
  BoxTree tree_;                        ///< of edges
  std::vector<VertexPlace> places_;     ///< by vertex
  IndexedVector<PatchId, int> common_;  ///< zero between calls
  std::vector<std::pair<PatchId, PatchId>> doubtful_;
  std::map<PatchId, std::vector<TriangleCorners>> triangles_;  ///< once asked for
  std::int64_t steps_left_;
};

}  // namespace

bool are_apart(const SnappedBuilding& building, const ValidateOptions& options,
               const Patches& patches, const PatchCorners& twins) {
  return ApartProof(building, options, patches, twins).run();
}

}  // namespace oriel::detail
