#include "kernel/segment/rings/rings.h"

#include "kernel/base/index.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/rings/feature_index.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// A polygon whose inner rings come this near to its outer one on all four sides is a frame: what
/// casement frames are wide, and some.
constexpr double kFrame_m = 0.15;
/// How far the sides of a notch must turn, and how straight they may go on (see
/// flush/contained_polygons.cpp).
constexpr double kNotch_deg = 150;
constexpr double kStraightSide_deg = 1;

/// In a plane, counter-clockwise.
Outline laid(const Plane& plane, Outline loop) {
  for (Vec3& p : loop) p = laid_on(plane, p);
  if (signed_area(loop, plane.normal) < 0) std::ranges::reverse(loop);
  return loop;
}

class RingFinder {
 public:
  RingFinder(const Solid& solid, const PolygonGrid& grid, const Tolerances& tolerances, Work& work)
      : solid_(solid),
        grid_(grid),
        tolerances_(tolerances),
        work_(work),
        is_open_(solid.shells.empty()) {}

  std::vector<Ring> run(FeatureIndex& features) {
    for (int f = 0; f < std::ssize(solid_.facets) && !work_.is_used_up(); ++f) find_rings_of(f);
    join_leaves();
    std::erase_if(
        rings_, [&](const Ring& ring) { return work_.is_used_up() || is_filled(ring, features); });
    if (rings_.size() > 1) sort();
    return std::move(rings_);
  }

 private:
  [[nodiscard]] const Plane& plane_of(int f) const {
    return solid_.planes[solid_.facets[at(f)].plane.index()];
  }
  [[nodiscard]] const Plane& plane_of(const Ring& ring) const {
    return plane_of(static_cast<int>(ring.facet.index()));
  }

  [[nodiscard]] bool is_filled(const Ring& ring, FeatureIndex& features) const {
    return features.fills(solid_.facets[ring.facet.index()].plane,
                          axes_in(plane_of(ring).normal).reach_of(ring.outline));
  }

  void find_rings_of(int f) {
    const Facet& facet = solid_.facets[at(f)];
    if (is_open_)
      for (const int source : facet.polygons) find_rings_of(f, source);
    for (std::size_t l = 0; l < facet.loops.size(); ++l) {
      if (l == 0 && !is_open_) continue;
      Ring ring = ring_of(solid_, FacetId{f}, facet.loops[l]);
      if (l > 0)
        add(std::move(ring));
      else
        find_notches(f, ring.outline);
    }
  }

  /// Of the front and the back of a frame, which are as large within kAlike, the one that looks
  /// the way of more walls with openings comes first, then the one that looks away from the middle
  /// of the building; of rings that look the same way the foremost.
  void sort() {
    Box box;
    for (const PlacedPolygon& polygon : grid_.polygons()) box.grow(polygon.box);
    const Vec3 middle = 0.5 * (box.min + box.max);
    const auto looking_m2 = areas_with_openings();
    std::ranges::sort(rings_, {}, [&](const Ring& r) {
      const Vec3 p = r.outline[0];
      const Plane& plane = plane_of(r);
      const auto size = std::llround(std::log(r.area_m2) / kAlike);
      const auto looking = looking_m2.find(plane.coefficients);
      const bool looks_inward = dot(plane.normal, p - middle) < 0;
      return std::tuple(-size, looking == looking_m2.end() ? 0 : -looking->second, looks_inward,
                        plane.coefficients, -plane.offset_m, r.facet, p.x, p.y, p.z);
    });
  }

  /// Of the polygons with inner rings that are no frames, by the direction of their plane.
  [[nodiscard]] std::map<std::array<std::int64_t, 3>, double> areas_with_openings() const {
    std::map<std::array<std::int64_t, 3>, double> areas_m2;
    for (const Facet& facet : solid_.facets) {
      const Plane& plane = solid_.planes[facet.plane.index()];
      for (const int source : facet.polygons)
        if (const PlacedPolygon& p = grid_.of(source);
            p.rings.size() > 1 && !is_frame(p, plane.normal))
          areas_m2[plane.coefficients] += length(p.area);
    }
    return areas_m2;
  }

  /// Rings of an input polygon that lies flush with what fills them are none of the facet.
  void find_rings_of(int f, int source) {
    const PlacedPolygon& polygon = grid_.of(source);
    for (std::size_t r = 1; r < polygon.rings.size(); ++r)
      add({FacetId{f}, laid(plane_of(f), polygon.rings[r]), 0, Ring::Kind::inner, source});
    if (is_frame(polygon, plane_of(f).normal))
      add({FacetId{f}, laid(plane_of(f), polygon.outline()), 0, Ring::Kind::frame, source});
  }

  /// Two frames side by side in one plane are the leaves of one opening; more of them are a row.
  void join_leaves() {
    for (auto& [plane, row] : leaves_by_plane()) {
      count_neighbours(row);
      for (const Leaf& leaf : row) {
        if (leaf.left != 0 || leaf.right != 1) continue;
        const Leaf& other = row[leaf.next];
        if (other.left == 1 && other.right == 0) join(leaf.ring, leaf.reach, other.reach);
      }
    }
  }

  struct Leaf {
    std::size_t ring;
    Reach reach;
    int left = 0, right = 0;  ///< how many stand beside it
    std::size_t next = 0;     ///< the one to its right
  };

  /// The rectangular frames, from left to right.
  [[nodiscard]] std::map<PlaneId, std::vector<Leaf>> leaves_by_plane() const {
    std::map<PlaneId, std::vector<Leaf>> leaves;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      if (rings_[r].kind != Ring::Kind::frame) continue;
      const Reach reach = axes_in(plane_of(rings_[r]).normal).reach_of(rings_[r].outline);
      if (rings_[r].area_m2 >= kRectangle * reach.area())
        leaves[solid_.facets[rings_[r].facet.index()].plane].push_back({r, reach});
    }
    for (auto& [plane, row] : leaves)
      std::ranges::sort(row, {}, [](const Leaf& l) { return std::tuple(l.reach.u0, l.reach.v0); });
    return leaves;
  }

  void count_neighbours(std::vector<Leaf>& row) const {
    for (Leaf& leaf : row) {
      auto beside = std::ranges::lower_bound(row, leaf.reach.u1 - kLean_m, {},
                                             [](const Leaf& l) { return l.reach.u0; });
      for (; beside != row.end() && beside->reach.u0 <= leaf.reach.u1 + kLean_m; ++beside) {
        work_.add(1);
        if (work_.is_used_up()) return;
        if (std::abs(beside->reach.v0 - leaf.reach.v0) > kLean_m ||
            std::abs(beside->reach.v1 - leaf.reach.v1) > kLean_m)
          continue;
        ++leaf.right;
        ++beside->left;
        leaf.next = static_cast<std::size_t>(beside - row.begin());
      }
    }
  }

  void join(std::size_t leaf, const Reach& left, const Reach& right) {
    const Ring& ring = rings_[leaf];
    const Plane& plane = plane_of(ring);
    const ReachAxes axes = axes_in(plane.normal);
    const double v0 = std::min(left.v0, right.v0), v1 = std::max(left.v1, right.v1);
    Outline outline;
    for (const auto& [u, v] : {std::pair(left.u0, v0), std::pair(right.u1, v0),
                               std::pair(right.u1, v1), std::pair(left.u0, v1)})
      outline.push_back(u * axes.u + v * axes.v + plane.offset_m * plane.normal);
    add({ring.facet, std::move(outline), 0, Ring::Kind::frame, ring.source});
  }

  [[nodiscard]] static bool is_frame(const PlacedPolygon& polygon, Vec3 normal) {
    if (polygon.rings.size() < 2) return false;
    const ReachAxes axes = axes_in(normal);
    std::vector<Vec3> inner;
    for (std::size_t r = 1; r < polygon.rings.size(); ++r)
      inner.insert(inner.end(), polygon.rings[r].begin(), polygon.rings[r].end());
    return axes.reach_of(inner).holds(axes.reach_of(polygon.outline()), kFrame_m);
  }

  /// Slits are no rings, and no ring counts twice.
  void add(Ring ring) {
    const Vec3 normal = plane_of(ring).normal;
    ring.area_m2 = signed_area(ring.outline, normal);
    work_.add(std::ssize(ring.outline));
    if (is_slit(ring, tolerances_)) return;
    start_at_least(ring.outline);
    const Reach reach = axes_in(normal).reach_of(ring.outline);
    const auto place = [](double c) { return static_cast<long>(std::floor(c / (4 * kLean_m))); };
    const long u = place(reach.u0), v = place(reach.v0);
    for (long i = u - 1; i <= u + 1; ++i)
      for (long j = v - 1; j <= v + 1; ++j)
        if (const auto near = known_.find({ring.facet, i, j}); near != known_.end())
          for (const Reach& other : near->second) {
            work_.add(1);
            if (reach.holds(other, kLean_m) && other.holds(reach, kLean_m)) return;
          }
    known_[{ring.facet, u, v}].push_back(reach);
    rings_.push_back(std::move(ring));
  }

  /// Chains of a facet's outer loop that turn inward around three sides. Those of single polygons
  /// are for add_imprints: what fills them is flush.
  void find_notches(int f, const Outline& loop) {
    const Vec3 normal = plane_of(f).normal;
    const std::size_t size = loop.size();
    const auto side = [&](std::size_t i) { return loop[(i + 1) % size] - loop[i % size]; };
    const auto turn_deg = [&](std::size_t i) {  // from side i to the next one, to the left
      const Vec3 p = side(i), q = side(i + 1);
      return std::atan2(dot(cross(p, q), normal), dot(p, q)) * 180 / std::numbers::pi;
    };
    const auto goes_on = [&](std::size_t i) { return turn_deg(i) <= kStraightSide_deg; };
    std::size_t start = 0;
    while (start < size && goes_on(start)) ++start;
    if (start == size) return;
    for (std::size_t i = start + 1; i <= start + size; ++i) {
      const std::size_t first = i;
      double turn = 0;
      for (; goes_on(i); ++i) turn -= turn_deg(i);
      if (i - first < 2 || turn < kNotch_deg) continue;
      Outline outline;
      for (std::size_t k = first; k <= i + 1; ++k) outline.push_back(loop[k % size]);
      std::ranges::reverse(outline);
      add({FacetId{f}, std::move(outline), 0, Ring::Kind::notch, -1});
    }
  }

  const Solid& solid_;
  const PolygonGrid& grid_;
  const Tolerances& tolerances_;
  Work& work_;
  bool is_open_;
  std::vector<Ring> rings_;
  std::map<std::tuple<FacetId, long, long>, std::vector<Reach>> known_;  ///< of rings, by place
};

}  // namespace

Ring ring_of(const Solid& solid, FacetId facet, const Loop& loop) {
  const Plane& plane = solid.planes[solid.facets[facet.index()].plane.index()];
  Outline outline;
  outline.reserve(loop.size());
  for (const int v : loop) outline.push_back(solid.vertices[at(v)].point);
  outline = laid(plane, std::move(outline));
  const double area_m2 = signed_area(outline, plane.normal);
  return {facet, std::move(outline), area_m2, Ring::Kind::inner, -1};
}

bool is_slit(const Ring& ring, const Tolerances& tolerances) {
  return ring.area_m2 <= tolerances.weld_m * perimeter(ring.outline) / 2;
}

std::vector<Ring> find_rings(const Solid& solid, const PolygonGrid& grid, FeatureIndex& features,
                             const Tolerances& tolerances, Work& work) {
  return RingFinder(solid, grid, tolerances, work).run(features);
}

}  // namespace oriel::detail
