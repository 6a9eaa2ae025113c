#include "kernel/solidify/planes/snap.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/geometry/axis_corners.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/solidify/planes/number_table.h"
#include "model/description/counting_sort.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace oriel::detail {

namespace {

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

}  // namespace

Vec3 nearest_point(const std::vector<Plane>& planes, Vec3 start, double reach) {
  ORIEL_ASSERT(reach >= 0);
  // Tolerances of nothing: they only keep the system regular along free directions.
  constexpr double kWeakest = 1e-4, kStrongest = 1;
  for (double pull = kWeakest; pull <= kStrongest; pull *= 10) {
    const Vec3 shift = least_squares_shift(planes, start, pull);
    if (length(shift) <= reach) return start + shift;
  }
  return start;
}

namespace {

/// The plane turned so that its first non-zero coefficient is positive: equal for both
/// orientations.
Plane unoriented(const Plane& plane) {
  const auto leading =
      std::ranges::find_if(plane.coefficients, [](std::int64_t n) { return n != 0; });
  return *leading < 0 ? exact::opposite(plane) : plane;
}

bool is_same_plane(const Plane& p, const Plane& q) {
  return p.offset == q.offset && p.coefficients == q.coefficients;
}

class Snapper {
 public:
  Snapper(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& mesh, FacetDraft draft,
          const Tolerances& tolerances)
      : soup_(soup),
        clusters_(clusters),
        mesh_(mesh),
        draft_(std::move(draft)),
        tolerances_(tolerances),
        reach_m_(4 * tolerances.plane_offset_m),
        corners_(soup.grid_m),
        merged_(mesh.vertex_count()) {}

  SnappedSolid run() {
    number_planes();
    collect_planes();
    place_of_.resize(mesh_.vertex_count());
    for (int v = 0; v < std::ssize(place_of_); ++v)
      if (!place_at_corner(v)) place(v);
    if (may_have_close_neighbours())
      while (unite_close_neighbours()) {
      }
    if (has_united_ || has_small_component())
      find_vanished();
    else
      keep_all();
    return assemble();
  }

 private:
  /// Numbers the planes so that both ways round of one have the same number.
  void number_planes() {
    NumberTable numbers(2 * clusters_.planes.size());
    planes_.reserve(clusters_.planes.size());
    corners_.reserve(clusters_.planes.size());
    number_of_.reserve(clusters_.planes.size());
    for (const Plane& plane : clusters_.planes) {
      const Plane turned = unoriented(plane);
      int& number = numbers.at(table_key(turned.coefficients, turned.offset),
                               [&](int n) { return is_same_plane(planes_[at(n)], turned); });
      if (number < 0) {
        number = static_cast<int>(planes_.size());
        planes_.push_back(turned);
        corners_.add(turned);
      }
      number_of_.push_back(number);
    }
  }

  /// The planes of every vertex, each once.
  void collect_planes() {
    plane_end_.assign(mesh_.vertex_count(), 0);
    for (const int v : draft_.vertices) ++plane_end_[at(v)];
    count_to_first(plane_end_);
    plane_begin_ = plane_end_;
    planes_at_.resize(draft_.vertices.size());
    int *const planes = planes_at_.data(), *const end_of = plane_end_.data();
    const int* const begin_of = plane_begin_.data();
    const int* vertex = draft_.vertices.data();
    for (std::size_t f = 0; f < draft_.facet_count(); ++f) {
      const int plane = number_of_[at(draft_.plane[f])];
      const int* const end =
          draft_.vertices.data() + draft_.first_vertex[at(draft_.first_loop[f + 1])];
      for (; vertex != end; ++vertex) {
        int* const last = planes + end_of[*vertex];
        if (contains({planes + begin_of[*vertex], last}, plane)) continue;
        *last = plane;
        ++end_of[*vertex];
      }
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

  /// Where the vertex was, in metres.
  [[nodiscard]] Vec3 start_of(int v) const {
    const exact::GridPoint& p = soup_.points[at(mesh_.point_of[at(v)])];
    return {static_cast<double>(p[0]) * soup_.grid_m, static_cast<double>(p[1]) * soup_.grid_m,
            static_cast<double>(p[2]) * soup_.grid_m};
  }

  /// As place() does, if three planes across the axes meet there: as in most places.
  bool place_at_corner(int v) {
    const auto planes = planes_of(v);
    if (planes.size() != 3) return false;
    const auto corner = corners_.meeting(planes[0], planes[1], planes[2]);
    if (!corner || !(length(*corner - start_of(v)) <= reach_m_)) return false;
    Vertex& place = place_of_[at(v)];
    place.point = *corner;
    place.is_meeting = true;
    return true;
  }

  void place(int v) {
    const auto planes = planes_of(v);
    if (planes.empty()) return;
    const Vec3 start = start_of(v);
    if (planes.size() == 3) {
      const auto point = meeting_of(planes[0], planes[1], planes[2]);
      if (point && length(*point - start) <= reach_m_) {
        place_of_[at(v)] = {*point, true};
        return;
      }
    }
    const Vec3 best = nearest_point(sorted_planes(planes), start, reach_m_);
    place_of_[at(v)] = {exact::to_metres(exact::round_to_grid(best, soup_.grid_m), soup_.grid_m),
                        false};
  }

  [[nodiscard]] std::optional<Vec3> meeting_of(int p, int q, int r) const {
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

  /// False if the ends of no edge lie within weld_m, as placed at first: of the shortest one by
  /// its square, which may be off by rounding.
  [[nodiscard]] bool may_have_close_neighbours() const {
    const Vertex* const places = place_of_.data();
    double least = Box::kInfinity;
    for (std::size_t l = 0; l < draft_.loop_count(); ++l) {
      const auto loop = draft_.loop(l);
      Vec3 before = places[loop.back()].point;
      for (const int v : loop) {
        const Vec3 here = places[v].point, edge = here - before;
        least = std::min(least, dot(edge, edge));
        before = here;
      }
    }
    constexpr double kRounding = 1e-9;
    return least < (1 + kRounding) * tolerances_.weld_m * tolerances_.weld_m;
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

  /// True if there is a component of fewer than three facets. In no other one two lie back to back
  /// as drafted: the neighbours of each are all the facet behind it.
  [[nodiscard]] bool has_small_component() const {
    Numbers size(at(draft_.components), 0);
    for (const int c : draft_.component) ++size[at(c)];
    return std::ranges::any_of(size, [](int facets) { return facets < 3; });
  }

  /// All facets and loops as drafted.
  void keep_all() {
    has_vanished_.assign(draft_.facet_count(), 0);
    loop_size_.resize(draft_.loop_count());
    for (std::size_t l = 0; l < loop_size_.size(); ++l) loop_size_[l] = draft_.loop(l).size();
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
        facet.loops.push_back(numbered(cleaned(l), number));
      }
      facet.polygons.assign(polygons[f].begin(), polygons[f].end());
      for (int& p : facet.polygons) p = soup_.polygons[at(p)].source;
      if (facet.polygons.size() > 1) {
        std::ranges::sort(facet.polygons);
        const auto repeated = std::ranges::unique(facet.polygons);  // pieces of one polygon
        facet.polygons.erase(repeated.begin(), repeated.end());
      }
      if (facet.polygons.front() < 0)  // of oriel's own
        facet.polygons.erase(facet.polygons.begin(), std::ranges::lower_bound(facet.polygons, 0));
    }
    return out;
  }

  /// The loop in the numbers of the solid, from the smallest one; if that comes twice, from the
  /// smallest vertex of the mesh.
  static Loop numbered(std::span<const int> vertices, const Numbers& number) {
    std::size_t start = 0;
    bool comes_twice = false;
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      const int mine = number[at(vertices[i])], smallest = number[at(vertices[start])];
      if (mine > smallest) continue;
      comes_twice = mine == smallest;
      start = i;
    }
    if (comes_twice)
      start = static_cast<std::size_t>(std::ranges::min_element(vertices) - vertices.begin());
    Loop loop(vertices.size());
    int* out = loop.data();
    for (const int v : vertices.subspan(start)) *out++ = number[at(v)];
    for (const int v : vertices.first(start)) *out++ = number[at(v)];
    return loop;
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
  double reach_m_;             ///< no vertex is put further from where it was
  std::vector<Plane> planes_;  ///< each once, one way round
  AxisCorners corners_;        ///< of planes_
  Numbers number_of_;          ///< in planes_, by plane of the clusters
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
  ORIEL_ASSERT(clusters.plane_of.size() == soup.polygons.size());
  ORIEL_ASSERT(draft.facet_of.size() == soup.polygons.size());
  return Snapper(soup, clusters, mesh, std::move(draft), tolerances).run();
}

}  // namespace oriel::detail
