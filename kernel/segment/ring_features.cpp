#include "kernel/segment/ring_features.h"

#include "kernel/geometry/planar.h"
#include "kernel/geometry/visible_level.h"
#include "kernel/segment/detail/polygon_grid.h"
#include "kernel/segment/detail/reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace oriel {

namespace {

using detail::Outline;
using detail::PlacedPolygon;
using detail::Reach;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// What floats in an opening is no further from the rest than an old wall is thick; nothing that
/// belongs to an opening is deeper than a loggia.
constexpr double kGap_m = 0.5;
constexpr double kDeepest_m = 4;
/// Reveals may lean, and frames overlap the ring, by this much.
constexpr double kLean_m = 0.02;
/// What looks along the normal of the facet, or against it, by 45° or less is in front of it or
/// behind it; the rest are sides.
const double kParallel = std::sqrt(0.5);
/// The caps of a feature fill this part of a ring's rectangle: it is the ring's. As for the boxes
/// of objects in bench/recall.sh.
constexpr double kSame = 0.8;
/// A notch is a ring if what is parallel in it fills this part of it.
constexpr double kFilled = 0.5;
/// A polygon whose inner rings come this near to its outer one on all four sides is a frame: what
/// casement frames are wide, and some.
constexpr double kFrame_m = 0.15;
/// An outline that fills this part of its rectangle is one.
constexpr double kRectangle = 0.999;
/// Sizes that differ by no more than about this share may be those of one thing.
constexpr double kAlike = 0.05;
/// How far the sides of a notch must turn, and how straight they may go on (see detail/insets.cpp).
constexpr double kNotch_deg = 150;
constexpr double kStraight_deg = 1;

struct Ring {
  FacetId facet;
  Outline outline;  ///< in the facet's plane, counter-clockwise seen from outside
  double area_m2 = 0;
  enum class Kind { inner, notch, frame } kind = Kind::inner;
  int source = -1;  ///< the input polygon it is a ring of, -1 if of the facet
};

/// What lies in a ring.
struct Content {
  std::vector<int> polygons;  ///< PolygonGrid::polygons
  double parallel_m2 = 0;
  std::optional<double> level_m;  ///< visible_level of what is parallel, along the facet's normal
};

class RingWriter {
 public:
  RingWriter(const Building& building, const Solid& solid, Segmentation& segmentation,
             const Tolerances& tolerances)
      : solid_(solid),
        out_(segmentation),
        tolerances_(tolerances),
        is_open_(solid.shells.empty()),
        grid_(building) {}

  void run() {
    std::vector<Ring> rings = find_rings();
    if (rings.empty()) return;
    find_homes();
    for (const Ring& ring : rings) write(ring);
    take_in();
  }

 private:
  [[nodiscard]] const Plane& plane_of(const Ring& ring) const {
    return solid_.planes[solid_.facets[ring.facet.index()].plane.index()];
  }
  [[nodiscard]] Vec3 point(int v) const { return solid_.vertices[at(v)].point; }

  // --- rings

  [[nodiscard]] std::vector<Ring> find_rings() {
    for (int f = 0; f < std::ssize(solid_.facets); ++f) {
      const Facet& facet = solid_.facets[at(f)];
      if (is_open_)
        for (const int source : facet.polygons) find_rings_of(f, source);
      for (std::size_t l = 0; l < facet.loops.size(); ++l) {
        std::vector<Vec3> points;
        for (const int v : facet.loops[l]) points.push_back(point(v));
        Outline loop = laid(f, std::move(points));
        if (l > 0)
          add({FacetId{f}, std::move(loop), 0, Ring::Kind::inner, -1});
        else if (is_open_)
          find_notches(f, loop);
      }
    }
    join_leaves();
    // Of the front and the back of a frame, which are as large within kAlike, the one that looks
    // the way of more walls with openings comes first,
    // then the one that looks away from the middle of the building.
    Box box;
    for (const PlacedPolygon& polygon : grid_.polygons()) box.grow(polygon.box);
    const Vec3 middle = 0.5 * (box.min + box.max);
    std::map<std::array<std::int64_t, 3>, double> looking_m2;
    for (const Facet& facet : solid_.facets) {
      const Plane& plane = solid_.planes[facet.plane.index()];
      for (const int source : facet.polygons)
        if (const PlacedPolygon& p = grid_.of(source);
            p.rings.size() > 1 && !is_frame(p, plane.normal))
          looking_m2[plane.coefficients] += length(p.area);
    }
    std::ranges::sort(rings_, {}, [&](const Ring& r) {
      const Vec3 p = r.outline[0];
      const auto size = std::llround(std::log(r.area_m2) / kAlike);
      const bool looks_inward = dot(plane_of(r).normal, p - middle) < 0;
      return std::tuple(-size, -looking_m2[plane_of(r).coefficients], looks_inward, r.facet, p.x,
                        p.y, p.z);
    });
    return std::move(rings_);
  }

  /// Rings of an input polygon that lies flush with what fills them are none of the facet.
  void find_rings_of(int f, int source) {
    const PlacedPolygon& polygon = grid_.of(source);
    for (std::size_t r = 1; r < polygon.rings.size(); ++r)
      add({FacetId{f}, laid(f, polygon.rings[r]), 0, Ring::Kind::inner, source});
    if (is_frame(polygon, solid_.planes[solid_.facets[at(f)].plane.index()].normal))
      add({FacetId{f}, laid(f, polygon.outline()), 0, Ring::Kind::frame, source});
  }

  /// Two frames side by side in one plane are the leaves of one opening; more of them are a row.
  void join_leaves() {
    struct Leaf {
      std::size_t ring;
      Reach reach;
      int left = 0, right = 0;  ///< how many stand beside it
      std::size_t next = 0;     ///< the one to its right
    };
    std::map<PlaneId, std::vector<Leaf>> leaves;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      if (rings_[r].kind != Ring::Kind::frame) continue;
      const Reach reach = detail::axes_in(plane_of(rings_[r]).normal).reach_of(rings_[r].outline);
      if (rings_[r].area_m2 >= kRectangle * reach.area())
        leaves[solid_.facets[rings_[r].facet.index()].plane].push_back({r, reach});
    }
    for (auto& [plane, row] : leaves) {
      std::ranges::sort(row, {}, [](const Leaf& l) { return std::tuple(l.reach.u0, l.reach.v0); });
      for (Leaf& leaf : row) {
        auto beside = std::ranges::lower_bound(row, leaf.reach.u1 - kLean_m, {},
                                               [](const Leaf& l) { return l.reach.u0; });
        for (; beside != row.end() && beside->reach.u0 <= leaf.reach.u1 + kLean_m; ++beside) {
          if (std::abs(beside->reach.v0 - leaf.reach.v0) > kLean_m ||
              std::abs(beside->reach.v1 - leaf.reach.v1) > kLean_m)
            continue;
          ++leaf.right;
          ++beside->left;
          leaf.next = static_cast<std::size_t>(beside - row.begin());
        }
      }
      for (const Leaf& leaf : row) {
        if (leaf.left != 0 || leaf.right != 1) continue;
        const Leaf& other = row[leaf.next];
        if (other.left == 1 && other.right == 0) join(leaf.ring, leaf.reach, other.reach);
      }
    }
  }

  void join(std::size_t leaf, const Reach& left, const Reach& right) {
    const Ring& ring = rings_[leaf];
    const Plane& plane = plane_of(ring);
    const detail::PlaneAxes axes = detail::axes_in(plane.normal);
    const double v0 = std::min(left.v0, right.v0), v1 = std::max(left.v1, right.v1);
    Outline outline;
    for (const auto& [u, v] : {std::pair(left.u0, v0), std::pair(right.u1, v0),
                               std::pair(right.u1, v1), std::pair(left.u0, v1)})
      outline.push_back(u * axes.u + v * axes.v + plane.offset_m * plane.normal);
    add({ring.facet, std::move(outline), 0, Ring::Kind::frame, ring.source});
  }

  [[nodiscard]] static bool is_frame(const PlacedPolygon& polygon, Vec3 normal) {
    if (polygon.rings.size() < 2) return false;
    const detail::PlaneAxes axes = detail::axes_in(normal);
    std::vector<Vec3> inner;
    for (std::size_t r = 1; r < polygon.rings.size(); ++r)
      inner.insert(inner.end(), polygon.rings[r].begin(), polygon.rings[r].end());
    return axes.reach_of(inner).holds(axes.reach_of(polygon.outline()), kFrame_m);
  }

  /// In the plane of a facet, counter-clockwise.
  [[nodiscard]] Outline laid(int f, Outline loop) const {
    const Plane& plane = solid_.planes[solid_.facets[at(f)].plane.index()];
    for (Vec3& p : loop) p = p + (plane.offset_m - dot(p, plane.normal)) * plane.normal;
    if (detail::signed_area(loop, plane.normal) < 0) std::ranges::reverse(loop);
    return loop;
  }

  /// Slits are no rings, and no ring counts twice.
  void add(Ring ring) {
    const Vec3 normal = plane_of(ring).normal;
    ring.area_m2 = detail::signed_area(ring.outline, normal);
    if (ring.area_m2 <= tolerances_.weld_m * detail::perimeter(ring.outline) / 2) return;
    detail::start_at_least(ring.outline);
    const Reach reach = detail::axes_in(normal).reach_of(ring.outline);
    const auto place = [](double c) { return static_cast<long>(std::floor(c / (4 * kLean_m))); };
    const long u = place(reach.u0), v = place(reach.v0);
    for (long i = u - 1; i <= u + 1; ++i)
      for (long j = v - 1; j <= v + 1; ++j)
        if (const auto near = known_.find({ring.facet, i, j}); near != known_.end())
          for (const Reach& other : near->second)
            if (reach.holds(other, kLean_m) && other.holds(reach, kLean_m)) return;
    known_[{ring.facet, u, v}].push_back(reach);
    rings_.push_back(std::move(ring));
  }

  /// Chains of a facet's outer loop that turn inward around three sides. Those of single polygons
  /// are for add_imprints: what fills them is flush.
  void find_notches(int f, const Outline& loop) {
    const Vec3 normal = solid_.planes[solid_.facets[at(f)].plane.index()].normal;
    const std::size_t size = loop.size();
    const auto side = [&](std::size_t i) { return loop[(i + 1) % size] - loop[i % size]; };
    const auto turn_deg = [&](std::size_t i) {  // from side i to the next one, to the left
      const Vec3 p = side(i), q = side(i + 1);
      return std::atan2(dot(cross(p, q), normal), dot(p, q)) * 180 / std::numbers::pi;
    };
    const auto goes_on = [&](std::size_t i) { return turn_deg(i) <= kStraight_deg; };
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

  // --- what is there already

  void find_homes() {
    for (int c = 0; c < std::ssize(out_.cells); ++c) {
      const auto& facets = out_.cells[at(c)].facets;
      for (int f = 0; f < std::ssize(facets); ++f)
        for (const int polygon : facets[at(f)].polygons) home_[polygon] = {CellId{c}, f};
    }
    for (int i = 0; i < std::ssize(out_.features); ++i)
      for (const PlaneId plane : out_.features[at(i)].planes)
        residents_[plane].push_back({FeatureId{i}, cap_of(FeatureId{i}, plane)});
    for (auto& [plane, residents] : residents_)
      std::ranges::stable_sort(residents, {}, [](const Resident& r) { return r.cap.u0; });
  }

  struct Resident {
    FeatureId id;
    Reach cap;  ///< of its points in that plane
  };

  [[nodiscard]] Reach cap_of(FeatureId id, PlaneId number) const {
    const Plane& plane = out_.planes[number.index()];
    std::vector<Vec3> cap;
    for (const int v : out_.features[id.index()].vertices) {
      const Vec3 p = out_.vertices[at(v)].point;
      if (std::abs(dot(plane.normal, p) - plane.offset_m) <= tolerances_.plane_offset_m)
        cap.push_back(p);
    }
    return detail::axes_in(plane.normal).reach_of(cap);
  }

  /// Features of the tree with a cap in a rectangle of a plane.
  [[nodiscard]] std::vector<Resident> residents_in(PlaneId plane, const Reach& reach) const {
    std::vector<Resident> within;
    const auto found = residents_.find(plane);
    if (found == residents_.end()) return within;
    const double slack = tolerances_.weld_m + tolerances_.plane_offset_m;
    auto r = std::ranges::lower_bound(found->second, reach.u0 - slack, {},
                                      [](const Resident& resident) { return resident.cap.u0; });
    for (; r != found->second.end() && r->cap.u0 <= reach.u1; ++r)
      if (reach.holds(r->cap, slack)) within.push_back(*r);
    return within;
  }

  // --- what lies in a ring

  /// By rectangle and, where the outline is no rectangle, by every corner.
  [[nodiscard]] static bool is_within(const PlacedPolygon& polygon, const Outline& outline,
                                      const detail::PlaneAxes& axes, const Reach& reach,
                                      Vec3 normal, bool is_rectangle) {
    if (!reach.holds(axes.reach_of(polygon.outline()), kLean_m)) return false;
    if (is_rectangle) return true;
    const double level = dot(outline[0], normal);
    return std::ranges::all_of(polygon.outline(), [&](Vec3 p) {
      const Vec3 q = p + (level - dot(p, normal)) * normal;
      if (detail::contains({&outline, 1}, normal, q)) return true;
      for (std::size_t i = 0; i < outline.size(); ++i)
        if (detail::distance_to_segment(q, outline[i], outline[(i + 1) % outline.size()]) <=
            kLean_m)
          return true;
      return false;
    });
  }

  [[nodiscard]] Content content_of(const Ring& ring) const {
    const Vec3 normal = plane_of(ring).normal;
    const double level = plane_of(ring).offset_m;
    const detail::PlaneAxes axes = detail::axes_in(normal);
    const Reach reach = axes.reach_of(ring.outline);
    const bool is_rectangle = ring.area_m2 >= kRectangle * reach.area();
    Box box;
    for (const Vec3 p : ring.outline) {
      box.grow(p + kDeepest_m * normal);
      box.grow(p - kDeepest_m * normal);
    }
    box.grow(box.min - Vec3{kLean_m, kLean_m, kLean_m});
    box.grow(box.max + Vec3{kLean_m, kLean_m, kLean_m});
    struct Layer {
      double near, far;  ///< along the normal from the facet
      int polygon;
    };
    std::vector<Layer> layers;
    std::vector<int> own;  // what the ring is cut into; a frame belongs to its opening
    if (ring.source < 0)
      own = solid_.facets[ring.facet.index()].polygons;
    else if (ring.kind != Ring::Kind::frame)
      own = {ring.source};
    for (const int p : grid_.within(box)) {
      const PlacedPolygon& polygon = grid_.polygons()[at(p)];
      if (std::ranges::binary_search(own, polygon.source)) continue;
      if (!is_within(polygon, ring.outline, axes, reach, normal, is_rectangle)) continue;
      Layer layer{Box::kInfinity, -Box::kInfinity, p};
      for (const Vec3 q : polygon.outline()) {
        layer.near = std::min(layer.near, dot(q, normal) - level);
        layer.far = std::max(layer.far, dot(q, normal) - level);
      }
      layers.push_back(layer);
    }
    Content content;
    std::vector<detail::ParallelArea> parallel;
    const auto take = [&](const Layer& layer) {
      const PlacedPolygon& polygon = grid_.polygons()[at(layer.polygon)];
      content.polygons.push_back(layer.polygon);
      const double across_m2 = std::abs(dot(polygon.area, normal));
      if (across_m2 < kParallel * length(polygon.area)) return;
      content.parallel_m2 += across_m2;
      parallel.push_back({(layer.near + layer.far) / 2, across_m2});
    };
    // Outwards, then inwards, as long as one follows the other closely.
    std::ranges::stable_sort(layers, {}, &Layer::near);
    double reached = kGap_m;
    std::vector<Layer> behind;
    for (const Layer& layer : layers) {
      if (layer.far < 0 || (layer.near < 0 && layer.far <= -layer.near)) {
        behind.push_back(layer);
        continue;
      }
      if (layer.near > reached) break;
      reached = std::max(reached, layer.far + kGap_m);
      take(layer);
    }
    std::ranges::stable_sort(behind, {}, [](const Layer& layer) { return -layer.far; });
    reached = -kGap_m;
    for (const Layer& layer : behind) {
      if (layer.far < reached) break;
      reached = std::min(reached, layer.near - kGap_m);
      take(layer);
    }
    content.level_m = detail::visible_level(std::move(parallel), ring.area_m2);
    std::ranges::sort(content.polygons);
    return content;
  }

  // --- features

  void write(const Ring& ring) {
    const PlaneId plane = solid_.facets[ring.facet.index()].plane;
    const Vec3 normal = plane_of(ring).normal;
    const detail::PlaneAxes axes = detail::axes_in(normal);
    const Reach reach = axes.reach_of(ring.outline);
    const std::vector<Resident> within = residents_in(plane, reach);
    if (std::ranges::any_of(
            within, [&](const Resident& r) { return r.cap.area() >= kSame * reach.area(); }))
      return;
    const auto home = home_of(ring);
    if (!home) return;
    const Content content = content_of(ring);
    if (ring.kind == Ring::Kind::notch && !is_recess(ring, content)) return;
    const FeatureId id{static_cast<int>(out_.features.size())};
    out_.features.push_back(make(ring, content, *home));
    for (const Resident& resident : within) {
      Feature& inner = out_.features[resident.id.index()];
      if (inner.planes.front() == plane && !inner.is_uncut &&
          detail::contains({&ring.outline, 1}, normal, inner.cap_point) &&
          !carries(resident.id, id))
        inner.host = id;
    }
    for (const int p : content.polygons) owner_[grid_.polygons()[at(p)].source] = id;
  }

  /// What fills a notch lies behind it: what is flush with the facet is for add_imprints.
  [[nodiscard]] bool is_recess(const Ring& ring, const Content& content) const {
    return content.parallel_m2 >= kFilled * ring.area_m2 &&
           content.level_m.value_or(0) < -tolerances_.plane_offset_m;
  }

  [[nodiscard]] bool carries(FeatureId carrier, FeatureId id) const {
    for (FeatureId host = id; host.is_valid(); host = out_.features[host.index()].host)
      if (host == carrier) return true;
    return false;
  }

  /// The largest polygon of the ring's facet.
  [[nodiscard]] int largest_of(const Ring& ring) const {
    const auto& polygons = solid_.facets[ring.facet.index()].polygons;
    return *std::ranges::max_element(polygons, {},
                                     [&](int source) { return length(grid_.of(source).area); });
  }

  /// The cell facet of the ring's polygon.
  [[nodiscard]] std::optional<CellFacet> home_of(const Ring& ring) const {
    const auto found = home_.find(ring.source < 0 ? largest_of(ring) : ring.source);
    return found == home_.end() ? std::nullopt : std::optional(found->second);
  }

  /// The smallest ring feature so far that has the ring's polygon; else the smallest that has most
  /// of what lies in the ring (the back of a pane may have a frame, too).
  [[nodiscard]] std::optional<FeatureId> owner_of(const Ring& ring, const Content& content) const {
    const int source = ring.source < 0 ? largest_of(ring) : ring.source;
    if (const auto owner = owner_.find(source); owner != owner_.end()) return owner->second;
    std::map<FeatureId, double> shares_m2;
    double all_m2 = 0;
    for (const int p : content.polygons) {
      const PlacedPolygon& polygon = grid_.polygons()[at(p)];
      all_m2 += length(polygon.area);
      const auto owner = owner_.find(polygon.source);
      FeatureId around = owner == owner_.end() ? FeatureId{} : owner->second;
      for (; around.is_valid(); around = out_.features[around.index()].host)
        shares_m2[around] += length(polygon.area);
    }
    std::optional<FeatureId> smallest;
    for (const auto& [owner, share_m2] : shares_m2)
      if (share_m2 > all_m2 / 2) smallest = owner;
    return smallest;
  }

  Feature make(const Ring& ring, const Content& content, CellFacet home) {
    Feature f;
    f.is_uncut = f.is_natural = true;
    const double level_m = content.level_m.value_or(0);
    const bool is_flat = std::abs(level_m) <= tolerances_.plane_offset_m;
    f.sense = is_flat ? Sense::imprint : level_m > 0 ? Sense::protrusion : Sense::hole;
    f.parent = f.host = out_.cells[home.cell.index()].feature;
    if (const auto owner = owner_of(ring, content)) f.host = *owner;
    f.host_facet = home;
    f.new_area_m2 = ring.area_m2;
    f.planes = {solid_.facets[ring.facet.index()].plane};
    f.cap_point =
        detail::interior_point({&ring.outline, 1}, plane_of(ring).normal).value_or(ring.outline[0]);
    std::vector<Vec3> corners = ring.outline;
    std::vector<double> areas_m2;
    for (const int p : content.polygons) {
      const PlacedPolygon& polygon = grid_.polygons()[at(p)];
      f.source_polygons.push_back(polygon.source);
      areas_m2.push_back(length(polygon.area));
      corners.insert(corners.end(), polygon.outline().begin(), polygon.outline().end());
    }
    std::ranges::sort(f.source_polygons);
    // In an order that does not know that of the input.
    std::ranges::sort(areas_m2);
    f.surface_m2 = std::accumulate(areas_m2.begin(), areas_m2.end(), 0.0);
    std::ranges::sort(corners, {}, [](Vec3 p) { return std::tuple(p.x, p.y, p.z); });
    for (const Vec3 p : ring.outline) f.outline.push_back(vertex_at(p));
    for (const Vec3 p : corners) {
      f.vertices.push_back(vertex_at(p));
      f.box.grow(p);
    }
    tidy(f.vertices);
    return f;
  }

  int vertex_at(Vec3 p) {
    const auto [entry, is_new] =
        vertex_.emplace(std::tuple(p.x, p.y, p.z), static_cast<int>(out_.vertices.size()));
    if (is_new) out_.vertices.push_back({p, false});
    return entry->second;
  }

  /// A ring feature holds what it hosts; inner ones, which stand behind outer ones, first.
  void take_in() {
    for (std::size_t i = out_.features.size(); i-- > 0;) {
      const Feature& inner = out_.features[i];
      if (!inner.host.is_valid()) continue;
      Feature& outer = out_.features[inner.host.index()];
      if (!outer.is_uncut || &outer == &inner) continue;
      outer.box.grow(inner.box);
      outer.vertices.insert(outer.vertices.end(), inner.vertices.begin(), inner.vertices.end());
      tidy(outer.vertices);
      outer.source_polygons.insert(outer.source_polygons.end(), inner.source_polygons.begin(),
                                   inner.source_polygons.end());
      tidy(outer.source_polygons);
    }
  }

  static void tidy(std::vector<int>& numbers) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }

  const Solid& solid_;
  Segmentation& out_;
  const Tolerances& tolerances_;
  bool is_open_;
  std::vector<Ring> rings_;
  std::map<std::tuple<FacetId, long, long>, std::vector<Reach>> known_;  ///< of rings, by place
  detail::PolygonGrid grid_;
  std::map<int, CellFacet> home_;  ///< by Polygon::source
  std::map<PlaneId, std::vector<Resident>> residents_;
  std::map<int, FeatureId> owner_;  ///< by Polygon::source: the smallest ring around it so far
  std::map<std::tuple<double, double, double>, int> vertex_;
};

}  // namespace

void add_ring_features(const Building& building, const Solid& solid, Segmentation& segmentation,
                       const Tolerances& tolerances) {
  RingWriter(building, solid, segmentation, tolerances).run();
}

}  // namespace oriel
