#include "kernel/solidify/detail/snap.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The plane turned so that its first non-zero coefficient is positive: equal for both
/// orientations.
Plane unoriented(const Plane& plane) {
  const auto leading =
      std::ranges::find_if(plane.coefficients, [](std::int64_t n) { return n != 0; });
  return *leading < 0 ? exact::opposite(plane) : plane;
}

/// The point with the least sum of squared distances to `planes`, drawn weakly towards `start`
/// where they leave it free.
Vec3 least_squares(const std::vector<Plane>& planes, Vec3 start) {
  constexpr double kPull =
      1e-4;  // tolerance of nothing: only keeps the system regular along free directions
  double m[3][3] = {{kPull, 0, 0}, {0, kPull, 0}, {0, 0, kPull}};
  Vec3 right;
  for (const Plane& plane : planes) {
    const double n[3] = {plane.normal.x, plane.normal.y, plane.normal.z};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m[i][j] += n[i] * n[j];
    right = right + (plane.offset_m - dot(plane.normal, start)) * plane.normal;
  }
  const Vec3 r0{m[0][0], m[0][1], m[0][2]}, r1{m[1][0], m[1][1], m[1][2]},
      r2{m[2][0], m[2][1], m[2][2]};
  const double det = dot(r0, cross(r1, r2));
  const Vec3 shift =
      (1 / det) * (right.x * cross(r1, r2) + right.y * cross(r2, r0) + right.z * cross(r0, r1));
  return start + shift;
}

class Snapper {
 public:
  Snapper(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& shell,
          FacetDraft& draft, const Tolerances& tolerances)
      : soup_(soup), clusters_(clusters), shell_(shell), draft_(draft), tolerances_(tolerances) {}

  Solid run(int& swallowed) {
    collect_planes();
    std::iota(merged_.begin(), merged_.end(), 0);
    for (int v = 0; v < std::ssize(planes_of_); ++v) place(v);
    while (unite_close_neighbours()) {
    }
    swallowed = drop_degenerate();
    return assemble();
  }

 private:
  void collect_planes() {
    planes_of_.resize(shell_.point_of.size());
    place_of_.resize(shell_.point_of.size());
    merged_.resize(shell_.point_of.size());
    for (const Facet& facet : draft_.facets)
      for (const Loop& loop : facet.loops)
        for (const int v : loop)
          planes_of_[at(v)].push_back(unoriented(clusters_.planes[facet.plane.index()]));
    for (auto& planes : planes_of_) make_unique(planes);
  }

  static void make_unique(std::vector<Plane>& planes) {
    const auto key = [](const Plane& p) { return std::tuple(p.coefficients, p.offset); };
    std::ranges::sort(planes, {}, key);
    planes.erase(std::unique(planes.begin(), planes.end(),
                             [&](const Plane& p, const Plane& q) { return key(p) == key(q); }),
                 planes.end());
  }

  void place(int v) {
    const auto& planes = planes_of_[at(v)];
    if (planes.empty()) return;
    const Vec3 start = exact::to_metres(soup_.points[at(shell_.point_of[at(v)])], soup_.grid_m);
    if (planes.size() == 3) {
      const auto meeting = exact::meet(planes[0], planes[1], planes[2]);
      if (meeting) {
        const Vec3 point = exact::to_metres(*meeting, soup_.grid_m);
        if (length(point - start) <= 4 * tolerances_.plane_offset_m) {
          place_of_[at(v)] = {point, true};
          return;
        }
      }
    }
    const Vec3 best = least_squares(planes, start);
    place_of_[at(v)] = {exact::to_metres(exact::round_to_grid(best, soup_.grid_m), soup_.grid_m),
                        false};
  }

  int find(int v) {
    while (merged_[at(v)] != v) v = merged_[at(v)] = merged_[at(merged_[at(v)])];
    return v;
  }

  /// One pass over all edges; true if a pair was united. The united vertex is placed anew, by all
  /// its planes.
  bool unite_close_neighbours() {
    bool has_changed = false;
    for (const Facet& facet : draft_.facets)
      for (const Loop& loop : facet.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const int v = find(loop[i]), w = find(loop[(i + 1) % loop.size()]);
          if (v == w ||
              length(place_of_[at(v)].point - place_of_[at(w)].point) >= tolerances_.weld_m)
            continue;
          const auto [first, second] = std::minmax(v, w);
          merged_[at(second)] = first;
          auto& planes = planes_of_[at(first)];
          planes.insert(planes.end(), planes_of_[at(second)].begin(), planes_of_[at(second)].end());
          make_unique(planes);
          place(first);
          has_changed = true;
        }
    return has_changed;
  }

  /// The same vertices the other way round, from the same start.
  static Loop reversed(Loop loop) {
    std::reverse(loop.begin() + 1, loop.end());
    return loop;
  }

  /// Facets without a loop vanish, and so do pairs that lie back to back: the two sides of a fin
  /// that is thinner than the tolerances.
  int drop_degenerate() {
    int dropped = 0;
    std::map<Loop, std::size_t> place_of_loop;  // of facets with one loop, among those kept
    std::vector<char> is_folded;
    std::vector<int> component;
    std::vector<Facet> facets;
    for (std::size_t f = 0; f < draft_.facets.size(); ++f) {
      Facet& facet = draft_.facets[f];
      for (Loop& loop : facet.loops) clean(loop);
      std::erase_if(facet.loops, [](const Loop& loop) { return loop.size() < 3; });
      if (facet.loops.empty()) {
        ++dropped;
        continue;
      }
      is_folded.push_back(0);
      if (facet.loops.size() == 1) {
        place_of_loop[facet.loops[0]] = facets.size();
        const auto other = place_of_loop.find(reversed(facet.loops[0]));
        if (other != place_of_loop.end()) is_folded.back() = is_folded[other->second] = 1;
      }
      facets.push_back(std::move(facet));
      component.push_back(draft_.component[f]);
    }
    dropped += static_cast<int>(std::ranges::count(is_folded, 1));
    std::size_t kept = 0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
      if (is_folded[f]) continue;
      if (kept != f) {
        facets[kept] = std::move(facets[f]);
        component[kept] = component[f];
      }
      ++kept;
    }
    facets.resize(kept);
    component.resize(kept);
    draft_.facets = std::move(facets);
    draft_.component = std::move(component);
    return dropped;
  }

  /// United vertices become one entry; a there-and-back (a, b, a) leaves a.
  void clean(Loop& loop) {
    Loop out;
    for (const int v : loop) {
      const int w = find(v);
      if (!out.empty() && out.back() == w) continue;
      if (out.size() > 1 && out[out.size() - 2] == w)
        out.pop_back();
      else
        out.push_back(w);
    }
    while (out.size() > 1 && out.front() == out.back()) out.pop_back();
    while (out.size() > 2 && out[1] == out.back()) {
      out.erase(out.begin());
      out.pop_back();
    }
    if (!out.empty()) std::ranges::rotate(out, std::ranges::min_element(out));
    loop = std::move(out);
  }

  /// Numbers the vertices in use in the order of the soup's points.
  Solid assemble() {
    Solid solid;
    solid.grid_m = soup_.grid_m;
    solid.planes = clusters_.planes;
    std::vector<int> used;
    for (const Facet& facet : draft_.facets)
      for (const Loop& loop : facet.loops) used.insert(used.end(), loop.begin(), loop.end());
    std::ranges::sort(used, {}, [&](int v) { return std::tuple(shell_.point_of[at(v)], v); });
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<int> number(planes_of_.size(), -1);
    for (const int v : used) {
      number[at(v)] = static_cast<int>(solid.vertices.size());
      solid.vertices.push_back(place_of_[at(v)]);
    }
    solid.facets = std::move(draft_.facets);
    for (Facet& facet : solid.facets)
      for (Loop& loop : facet.loops)
        for (int& v : loop) v = number[at(v)];
    return solid;
  }

  const Soup& soup_;
  const PlaneClusters& clusters_;
  const ShellMesh& shell_;
  FacetDraft& draft_;
  const Tolerances& tolerances_;
  std::vector<std::vector<Plane>> planes_of_;
  std::vector<Vertex> place_of_;
  std::vector<int> merged_;
};

}  // namespace

Solid snap_vertices(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& shell,
                    FacetDraft& draft, const Tolerances& tolerances, int& swallowed) {
  return Snapper(soup, clusters, shell, draft, tolerances).run(swallowed);
}

}  // namespace oriel::detail
