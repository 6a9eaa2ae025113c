#include "kernel/solidify/detail/snap.h"

#include "kernel/model/detail/counting_sort.h"
#include "kernel/model/detail/index.h"
#include "kernel/solidify/detail/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>

namespace oriel::detail {

namespace {

/// The plane turned so that its first non-zero coefficient is positive: equal for both
/// orientations.
Plane unoriented(const Plane& plane) {
  const auto leading =
      std::ranges::find_if(plane.coefficients, [](std::int64_t n) { return n != 0; });
  return *leading < 0 ? exact::opposite(plane) : plane;
}

/// From `start` to the point with the least sum of squared distances to `planes`, drawn back by
/// `pull` where they leave it free.
Vec3 least_squares_shift(const std::vector<Plane>& planes, Vec3 start, double pull) {
  double m[3][3] = {{pull, 0, 0}, {0, pull, 0}, {0, 0, pull}};
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
  return (1 / det) * (right.x * cross(r1, r2) + right.y * cross(r2, r0) + right.z * cross(r0, r1));
}

/// The point nearest to `planes`, no further than `reach` from `start`: planes of a wall and of a
/// panel in it that are a hair's breadth from parallel meet anywhere.
Vec3 nearest_point(const std::vector<Plane>& planes, Vec3 start, double reach) {
  // Tolerances of nothing: they only keep the system regular along free directions.
  constexpr double kWeakest = 1e-4, kStrongest = 1;
  for (double pull = kWeakest; pull <= kStrongest; pull *= 10) {
    const Vec3 shift = least_squares_shift(planes, start, pull);
    if (length(shift) <= reach) return start + shift;
  }
  return start;
}

struct PlaneHash {
  std::size_t operator()(const Plane& plane) const noexcept {
    std::uint64_t h = static_cast<std::uint64_t>(plane.offset);
    for (const std::int64_t c : plane.coefficients) {
      h = (h ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
      h ^= h >> 32;
    }
    return h;
  }
};

struct IsSamePlane {
  bool operator()(const Plane& p, const Plane& q) const {
    return p.offset == q.offset && p.coefficients == q.coefficients;
  }
};

class Snapper {
 public:
  Snapper(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& mesh, FacetDraft draft,
          const Tolerances& tolerances)
      : soup_(soup),
        clusters_(clusters),
        mesh_(mesh),
        draft_(std::move(draft)),
        tolerances_(tolerances),
        merged_(mesh.vertex_count()) {}

  SnappedSolid run() {
    number_planes();
    collect_planes();
    place_of_.resize(mesh_.vertex_count());
    for (int v = 0; v < std::ssize(place_of_); ++v) place(v);
    while (unite_close_neighbours()) {
    }
    find_vanished();
    return assemble();
  }

 private:
  /// Which axis a plane stands across, and where; axis 3: none.
  struct Across {
    std::size_t axis = 3;
    double level_m = 0;
  };
  [[nodiscard]] Across across(const Plane& turned) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<std::int64_t, 3> along{};
      along[axis] = 1;
      if (turned.coefficients == along)
        return {axis, static_cast<double>(turned.offset) * soup_.grid_m};
    }
    return {};
  }

  /// Numbers the planes so that both ways round of one have the same number.
  void number_planes() {
    std::unordered_map<Plane, int, PlaneHash, IsSamePlane> numbers;
    for (const Plane& plane : clusters_.planes) {
      const Plane turned = unoriented(plane);
      const int next = static_cast<int>(planes_.size());
      const auto [entry, is_new] = numbers.try_emplace(turned, next);
      if (is_new) {
        planes_.push_back(turned);
        across_.push_back(across(turned));
      }
      number_of_.push_back(entry->second);
    }
  }

  /// The planes of every vertex, each once.
  void collect_planes() {
    plane_end_.assign(mesh_.vertex_count(), 0);
    for (const int v : draft_.vertices) ++plane_end_[at(v)];
    count_to_first(plane_end_);
    plane_begin_ = plane_end_;
    planes_at_.resize(draft_.vertices.size());
    for (std::size_t f = 0; f < draft_.facet_count(); ++f) {
      const int plane = number_of_[at(draft_.plane[f])];
      const auto begin = draft_.vertices.begin() + draft_.first_vertex[at(draft_.first_loop[f])];
      const auto end = draft_.vertices.begin() + draft_.first_vertex[at(draft_.first_loop[f + 1])];
      for (auto v = begin; v != end; ++v)
        if (!contains(planes_of(*v), plane)) planes_at_[at(plane_end_[at(*v)]++)] = plane;
    }
  }

  static bool contains(std::span<const int> planes, int plane) {
    for (const int p : planes)
      if (p == plane) return true;
    return false;
  }

  [[nodiscard]] std::span<const int> planes_of(int v) const {
    return {planes_at_.data() + plane_begin_[at(v)], planes_at_.data() + plane_end_[at(v)]};
  }

  void place(int v) {
    const auto planes = planes_of(v);
    if (planes.empty()) return;
    const Vec3 start = exact::to_metres(soup_.points[at(mesh_.point_of[at(v)])], soup_.grid_m);
    const double reach = 4 * tolerances_.plane_offset_m;
    if (planes.size() == 3) {
      const auto point = meeting_of(planes[0], planes[1], planes[2]);
      if (point && length(*point - start) <= reach) {
        place_of_[at(v)] = {*point, true};
        return;
      }
    }
    const Vec3 best = nearest_point(sorted_planes(planes), start, reach);
    place_of_[at(v)] = {exact::to_metres(exact::round_to_grid(best, soup_.grid_m), soup_.grid_m),
                        false};
  }

  /// Most meet at right angles, across the axes: where is no question then.
  [[nodiscard]] std::optional<Vec3> meeting_of(int p, int q, int r) const {
    std::array<double, 4> corner{};
    unsigned axes = 0;
    for (const int plane : {p, q, r}) {
      const Across& here = across_[at(plane)];
      corner[here.axis] = here.level_m;
      axes |= 1U << here.axis;
    }
    constexpr unsigned kAllThree = 7;
    if (axes == kAllThree) return Vec3{corner[0], corner[1], corner[2]};
    const auto meeting = exact::meet(planes_[at(p)], planes_[at(q)], planes_[at(r)]);
    if (!meeting) return std::nullopt;
    return exact::to_metres(*meeting, soup_.grid_m);
  }

  /// In an order that their numbers have no part in.
  [[nodiscard]] std::vector<Plane> sorted_planes(std::span<const int> planes) const {
    std::vector<Plane> out;
    for (const int p : planes) out.push_back(planes_[at(p)]);
    std::ranges::sort(out, {}, [](const Plane& p) { return std::tuple(p.coefficients, p.offset); });
    return out;
  }

  /// One pass over all edges; true if a pair was united. The united vertex is placed anew, by all
  /// its planes.
  bool unite_close_neighbours() {
    bool has_changed = false;
    for (std::size_t l = 0; l < draft_.loop_count(); ++l) {
      const auto loop = draft_.loop(l);
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int v = united(loop[i]), w = united(loop[i + 1 < loop.size() ? i + 1 : 0]);
        if (v == w || length(place_of_[at(v)].point - place_of_[at(w)].point) >= tolerances_.weld_m)
          continue;
        unite(std::min(v, w), std::max(v, w));
        has_united_ = has_changed = true;
      }
    }
    return has_changed;
  }

  /// The vertex that a vertex is by now.
  [[nodiscard]] int united(int v) { return has_united_ ? merged_.find(v) : v; }

  /// The planes of the united vertex go to the end of the list.
  void unite(int first, int second) {
    merged_.unite(first, second);
    const auto mine = planes_of(first), theirs = planes_of(second);
    Numbers planes(mine.begin(), mine.end());
    for (const int p : theirs)
      if (!contains(mine, p)) planes.push_back(p);
    plane_begin_[at(first)] = static_cast<int>(planes_at_.size());
    planes_at_.insert(planes_at_.end(), planes.begin(), planes.end());
    plane_end_[at(first)] = static_cast<int>(planes_at_.size());
    place(first);
  }

  /// Facets without a loop vanish, and so do pairs that lie back to back: the two sides of a fin
  /// that is thinner than the tolerances.
  void find_vanished() {
    has_vanished_.assign(draft_.facet_count(), 0);
    loop_of_.assign(draft_.facet_count(), -1);
    loop_size_.resize(draft_.loop_count());
    // Facets with one loop by its first vertex: the newest, and before each the one before.
    Numbers newest(mesh_.vertex_count(), -1), before(draft_.facet_count(), -1);
    for (int f = 0; f < std::ssize(has_vanished_); ++f) {
      int loops = 0, loop = -1;
      for (int l = draft_.first_loop[at(f)]; l < draft_.first_loop[at(f) + 1]; ++l) {
        loop_size_[at(l)] = clean(draft_.loop(at(l)));
        if (loop_size_[at(l)] < 3) continue;
        ++loops;
        loop = l;
      }
      if (loops == 0) has_vanished_[at(f)] = 1;
      if (loops != 1) continue;
      loop_of_[at(f)] = loop;
      int& head = newest[at(cleaned(loop)[0])];
      before[at(f)] = head;
      head = f;
      for (int g = before[at(f)]; g >= 0; g = before[at(g)])
        if (is_reversed(cleaned(loop), cleaned(loop_of_[at(g)]))) {
          has_vanished_[at(f)] = has_vanished_[at(g)] = 1;
          break;
        }
    }
  }

  /// The loop after clean(); fewer than three vertices are none.
  [[nodiscard]] std::span<const int> cleaned(int loop) const {
    return std::as_const(draft_).loop(at(loop)).first(loop_size_[at(loop)]);
  }

  /// The same vertices the other way round, from the same start.
  static bool is_reversed(std::span<const int> loop, std::span<const int> other) {
    return loop.size() == other.size() && loop[0] == other[0] && loop[1] == other.back() &&
           std::equal(loop.begin() + 1, loop.end(), other.rbegin());
  }

  /// United vertices become one entry; a there-and-back (a, b, a) leaves a. What is left starts at
  /// its smallest vertex. Returns its size.
  std::size_t clean(std::span<int> loop) {
    if (!has_united_) {  // as drafted: no vertex twice in a row, no there-and-back
      std::ranges::rotate(loop, std::ranges::min_element(loop));
      return loop.size();
    }
    std::size_t size = 0;
    for (const int v : loop) {
      const int w = merged_.find(v);
      if (size > 0 && loop[size - 1] == w) continue;
      if (size > 1 && loop[size - 2] == w)
        --size;
      else
        loop[size++] = w;
    }
    std::size_t start = 0;
    while (size - start > 1 && loop[start] == loop[size - 1]) --size;
    while (size - start > 2 && loop[start + 1] == loop[size - 1]) {
      ++start;
      --size;
    }
    const auto rest = loop.subspan(start, size - start);
    std::ranges::rotate(rest, std::ranges::min_element(rest));
    if (start > 0) std::ranges::copy(rest, loop.begin());
    return rest.size();
  }

  /// Numbers the vertices in use in the order of the soup's points.
  SnappedSolid assemble() {
    SnappedSolid out;
    out.has_united = has_united_;
    Solid& solid = out.solid;
    solid.grid_m = soup_.grid_m;
    solid.planes = clusters_.planes;
    const Numbers number = number_vertices(solid);
    const Buckets polygons = sort_into_buckets(draft_.facet_of, draft_.facet_count());
    solid.facets.reserve(draft_.facet_count());
    out.component.reserve(draft_.facet_count());
    for (std::size_t f = 0; f < draft_.facet_count(); ++f) {
      if (has_vanished_[f]) {
        ++out.swallowed;
        continue;
      }
      out.component.push_back(draft_.component[f]);
      Facet& facet = solid.facets.emplace_back();
      facet.plane = PlaneId{draft_.plane[f]};
      facet.loops.reserve(at(draft_.first_loop[f + 1] - draft_.first_loop[f]));
      for (int l = draft_.first_loop[f]; l < draft_.first_loop[f + 1]; ++l) {
        if (loop_size_[at(l)] < 3) continue;
        const auto vertices = cleaned(l);
        Loop& loop = facet.loops.emplace_back(vertices.size());
        for (std::size_t i = 0; i < loop.size(); ++i) loop[i] = number[at(vertices[i])];
      }
      facet.polygons.reserve(polygons[f].size());
      for (const int p : polygons[f])
        if (const int source = soup_.polygons[at(p)].source; source >= 0)
          facet.polygons.push_back(source);
      if (facet.polygons.size() > 1) {
        std::ranges::sort(facet.polygons);
        const auto repeated = std::ranges::unique(facet.polygons);  // pieces of one polygon
        facet.polygons.erase(repeated.begin(), repeated.end());
      }
    }
    return out;
  }

  /// Appends the vertices in use to the solid; returns their numbers there.
  [[nodiscard]] Numbers number_vertices(Solid& solid) const {
    Numbers number(mesh_.vertex_count(), -1);
    for (std::size_t f = 0; f < draft_.facet_count(); ++f) {
      if (has_vanished_[f]) continue;
      for (int l = draft_.first_loop[f]; l < draft_.first_loop[f + 1]; ++l)
        if (loop_size_[at(l)] >= 3)
          for (const int v : cleaned(l)) number[at(v)] = 0;
    }
    solid.vertices.reserve(mesh_.vertex_count());
    for (const int v : sort_into_buckets(mesh_.point_of, soup_.points.size()).items) {
      if (number[at(v)] < 0) continue;
      number[at(v)] = static_cast<int>(solid.vertices.size());
      solid.vertices.push_back(place_of_[at(v)]);
    }
    return number;
  }

  const Soup& soup_;
  const PlaneClusters& clusters_;
  const ShellMesh& mesh_;
  FacetDraft draft_;
  const Tolerances& tolerances_;
  std::vector<Plane> planes_;   ///< each once, one way round
  std::vector<Across> across_;  ///< of each plane
  Numbers number_of_;           ///< in planes_, by plane of the clusters
  // The planes of vertex v: planes_at_[plane_begin_[v]] … planes_at_[plane_end_[v] - 1].
  Numbers plane_begin_, plane_end_, planes_at_;
  std::vector<Vertex> place_of_;
  DisjointSets merged_;
  bool has_united_ = false;
  std::vector<std::size_t> loop_size_;  ///< of each loop after clean()
  Numbers loop_of_;                     ///< of a facet with one loop
  std::vector<char> has_vanished_;
};

}  // namespace

SnappedSolid snap_vertices(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& mesh,
                           FacetDraft draft, const Tolerances& tolerances) {
  return Snapper(soup, clusters, mesh, std::move(draft), tolerances).run();
}

}  // namespace oriel::detail
