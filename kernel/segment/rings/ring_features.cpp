#include "kernel/segment/rings/ring_features.h"

#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/flush/polygon_grid.h"
#include "kernel/segment/rings/feature_index.h"
#include "kernel/segment/rings/rings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace oriel {

namespace {

using detail::PlacedPolygon;
using detail::PolygonGrid;
using detail::Ring;

/// What lies in a ring, before and behind its facet.
struct RingContent {
  std::vector<int> polygons;      ///< PolygonGrid::polygons, ascending
  double parallel_m2 = 0;         ///< of those that look along the facet's normal or against it
  std::optional<double> level_m;  ///< visible_level of what is parallel, along the facet's normal
};

/// What floats in an opening is no further from the rest than an old wall is thick; nothing that
/// belongs to an opening is deeper than a loggia.
constexpr double kGap_m = 0.5;
constexpr double kDeepest_m = 4;
/// What looks along the normal of the facet, or against it, by 45° or less is in front of it or
/// behind it; the rest are sides.
const double kFacing = std::sqrt(0.5);

/// Finds the polygons within the outline of a ring as seen along its facet's normal, from the facet
/// on outwards and inwards until there is a gap. Those that the ring is cut into are not among
/// them.
class ContentFinder {
 public:
  ContentFinder(const Ring& ring, const Solid& solid, const PolygonGrid& grid)
      : ring_(ring),
        facet_(solid.facets[ring.facet.index()]),
        plane_(solid.planes[facet_.plane.index()]),
        grid_(grid),
        axes_(axes_in(plane_.normal)),
        reach_(axes_.reach_of(ring.outline)),
        is_rectangle_(ring.area_m2 >= detail::kRectangle * reach_.area()) {}

  RingContent run() {
    for (const int p : grid_.within(room()))
      if (is_content(grid_.polygons()[at(p)])) place(p);
    take_outwards();
    take_inwards();
    out_.level_m = visible_level(parallel_, ring_.area_m2);
    std::ranges::sort(out_.polygons);
    return std::move(out_);
  }

 private:
  struct Layer {
    double near = Box::kInfinity, far = -Box::kInfinity;  ///< along the normal from the facet
    int polygon = -1;
  };

  [[nodiscard]] Box room() const {
    Box box;
    for (const Vec3 p : ring_.outline) {
      box.grow(p + kDeepest_m * plane_.normal);
      box.grow(p - kDeepest_m * plane_.normal);
    }
    box.grow(box.min - Vec3{detail::kLean_m, detail::kLean_m, detail::kLean_m});
    box.grow(box.max + Vec3{detail::kLean_m, detail::kLean_m, detail::kLean_m});
    return box;
  }

  [[nodiscard]] bool is_content(const PlacedPolygon& polygon) const {
    return !is_own(polygon.source) && is_within(polygon);
  }

  /// What the ring is cut into; a frame belongs to its opening.
  [[nodiscard]] bool is_own(int source) const {
    if (ring_.source < 0) return std::ranges::binary_search(facet_.polygons, source);
    return ring_.kind != Ring::Kind::frame && source == ring_.source;
  }

  /// By rectangle and, where the outline is no rectangle, by every corner.
  [[nodiscard]] bool is_within(const PlacedPolygon& polygon) const {
    if (!reach_.holds(axes_.reach_of(polygon.outline()), detail::kLean_m)) return false;
    if (is_rectangle_) return true;
    const Outline& outline = ring_.outline;
    const double level = dot(outline[0], plane_.normal);
    return std::ranges::all_of(polygon.outline(), [&](Vec3 p) {
      const Vec3 q = p + (level - dot(p, plane_.normal)) * plane_.normal;
      if (contains({&outline, 1}, plane_.normal, q)) return true;
      for (std::size_t i = 0; i < outline.size(); ++i)
        if (distance_to_segment(q, outline[i], outline[(i + 1) % outline.size()]) <=
            detail::kLean_m)
          return true;
      return false;
    });
  }

  void place(int p) {
    Layer layer;
    layer.polygon = p;
    for (const Vec3 q : grid_.polygons()[at(p)].outline()) {
      layer.near = std::min(layer.near, dot(q, plane_.normal) - plane_.offset_m);
      layer.far = std::max(layer.far, dot(q, plane_.normal) - plane_.offset_m);
    }
    const bool is_behind = layer.far < 0 || (layer.near < 0 && layer.far <= -layer.near);
    (is_behind ? behind_ : before_).push_back(layer);
  }

  void take_outwards() {
    std::ranges::stable_sort(before_, {}, &Layer::near);
    double reached = kGap_m;
    for (const Layer& layer : before_) {
      if (layer.near > reached) return;
      reached = std::max(reached, layer.far + kGap_m);
      take(layer);
    }
  }

  void take_inwards() {
    std::ranges::stable_sort(behind_, {}, [](const Layer& layer) { return -layer.far; });
    double reached = -kGap_m;
    for (const Layer& layer : behind_) {
      if (layer.far < reached) return;
      reached = std::min(reached, layer.near - kGap_m);
      take(layer);
    }
  }

  void take(const Layer& layer) {
    const PlacedPolygon& polygon = grid_.polygons()[at(layer.polygon)];
    out_.polygons.push_back(layer.polygon);
    const double across_m2 = std::abs(dot(polygon.area, plane_.normal));
    if (across_m2 < kFacing * length(polygon.area)) return;
    out_.parallel_m2 += across_m2;
    parallel_.push_back({(layer.near + layer.far) / 2, across_m2});
  }

  const Ring& ring_;
  const Facet& facet_;
  const Plane& plane_;
  const PolygonGrid& grid_;
  ReachAxes axes_;
  Reach reach_;
  bool is_rectangle_;
  std::vector<Layer> before_, behind_;
  std::vector<ParallelArea> parallel_;
  RingContent out_;
};

/// A notch is a ring if what is parallel in it fills this part of it.
constexpr double kFilled = 0.5;
/// The sides of a wall or a frame are parallel to within 8 degrees.
constexpr double kParallel = 0.99;
/// And no further apart than an old wall is thick.
constexpr double kWall_m = 0.5;

class RingWriter {
 public:
  RingWriter(const Building& building, const Solid& solid, Segmentation& segmentation,
             const Tolerances& tolerances, std::int64_t budget)
      : building_(building),
        solid_(solid),
        out_(segmentation),
        tolerances_(tolerances),
        work_(budget),
        index_(segmentation, tolerances, work_) {}

  void run() {
    const bool is_open = solid_.shells.empty();
    if (!is_open && are_all_rings_filled(solid_, index_, tolerances_)) return tell_work();
    grid_ = PolygonGrid(building_, solid_.grid_m);
    const std::vector<Ring> rings = detail::find_rings(solid_, grid_, index_, tolerances_, work_);
    if (rings.empty()) return tell_work();
    find_homes();
    for (const Ring& ring : rings)
      if (!work_.is_used_up()) write(ring);
    take_in();
    tell_work();
  }

 private:
  void tell_work() const {
    if (work_.is_used_up())
      out_.issues.push_back(used_up(building_.id, work_.budget(), "finding rings",
                                    "openings that no single cut isolates may be missing"));
  }

  [[nodiscard]] const Plane& plane_of(const Ring& ring) const {
    return solid_.planes[solid_.facets[ring.facet.index()].plane.index()];
  }

  // --- what is there already

  void find_homes() {
    for (const CellId c : ids_below<CellId>(out_.cells.size())) {
      const auto& facets = out_.cells[c.index()].facets;
      for (int f = 0; f < std::ssize(facets); ++f)
        for (const int polygon : facets[at(f)].polygons) {
          if (at(polygon) >= home_.size()) home_.resize(at(polygon) + 1);
          home_[at(polygon)] = {c, f};
        }
    }
  }

  // --- features

  void write(const Ring& ring) {
    const PlaneId plane = solid_.facets[ring.facet.index()].plane;
    const Vec3 normal = plane_of(ring).normal;
    const ReachAxes axes = axes_in(normal);
    const Reach reach = axes.reach_of(ring.outline);
    const auto home = home_of(ring);
    if (!home) return;
    const RingContent content = ContentFinder(ring, solid_, grid_).run();
    work_.add(std::ssize(ring.outline) * (1 + std::ssize(content.polygons)));
    if (ring.kind == Ring::Kind::notch && !is_recess(ring, content)) return;
    if (is_told(ring)) return;
    const std::optional<FeatureId> owner = owner_of(ring, content);
    const FeatureId id{static_cast<int>(out_.features.size())};
    out_.features.push_back(make(ring, content, *home, owner));
    for (const FeatureId inner_id : index_.within(plane, reach)) {
      Feature& inner = out_.features[inner_id.index()];
      if (inner.planes.front() == plane && !inner.is_uncut &&
          contains({&ring.outline, 1}, normal, inner.cap_point) && !carries(inner_id, id))
        inner.host = id;
    }
    for (const int p : content.polygons) owner_[grid_.polygons()[at(p)].source] = id;
  }

  /// A wall has an opening on both sides, and a frame in it a front and a back: one opening, told
  /// by the ring that comes first.
  [[nodiscard]] bool is_told(const Ring& ring) {
    const Vec3 normal = plane_of(ring).normal;
    const Reach reach = axes_in(normal).reach_of(ring.outline);
    Box box;
    for (const Vec3 p : ring.outline) box.grow(p);
    const Vec3 middle = 0.5 * (box.min + box.max);
    const auto place = [](double c) { return static_cast<long>(std::floor(c / kWall_m)); };
    const std::array<long, 3> here{place(middle.x), place(middle.y), place(middle.z)};
    for (long x = here[0] - 1; x <= here[0] + 1; ++x)
      for (long y = here[1] - 1; y <= here[1] + 1; ++y)
        for (long z = here[2] - 1; z <= here[2] + 1; ++z)
          if (const auto near = told_.find({x, y, z}); near != told_.end())
            for (const Told& other : near->second) {
              work_.add(1);
              if (is_other_side(ring, reach, middle, other)) return true;
            }
    told_[here].push_back({ring.outline, normal, middle});
    return false;
  }

  struct Told {
    Outline outline;
    Vec3 normal, middle;
  };

  [[nodiscard]] bool is_other_side(const Ring& ring, const Reach& reach, Vec3 middle,
                                   const Told& other) const {
    const Vec3 normal = plane_of(ring).normal;
    if (std::abs(dot(normal, other.normal)) < kParallel) return false;
    if (std::abs(dot(normal, middle - other.middle)) > kWall_m) return false;
    const Reach its = axes_in(normal).reach_of(other.outline);
    const Reach common = reach.common(its);
    return !common.is_empty() &&
           common.area() >= (1 - detail::kAlike) * std::max(reach.area(), its.area());
  }

  /// What fills a notch lies behind it: what is flush with the facet is for add_imprints.
  [[nodiscard]] bool is_recess(const Ring& ring, const RingContent& content) const {
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
    const std::size_t source = at(ring.source < 0 ? largest_of(ring) : ring.source);
    if (source >= home_.size() || !home_[source].cell.is_valid()) return std::nullopt;
    return home_[source];
  }

  /// The smallest ring feature so far that has the ring's polygon; else the smallest that has most
  /// of what lies in the ring (the back of a pane may have a frame, too).
  [[nodiscard]] std::optional<FeatureId> owner_of(const Ring& ring,
                                                  const RingContent& content) const {
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

  Feature make(const Ring& ring, const RingContent& content, CellFacet home,
               std::optional<FeatureId> owner) {
    Feature f;
    f.is_uncut = f.is_natural = true;
    const double level_m = content.level_m.value_or(0);
    const bool is_flat = std::abs(level_m) <= tolerances_.plane_offset_m;
    f.sense = is_flat ? Sense::imprint : level_m > 0 ? Sense::protrusion : Sense::hole;
    f.parent = f.host = out_.cells[home.cell.index()].feature;
    if (owner) f.host = *owner;
    f.host_facet = home;
    f.new_area_m2 = ring.area_m2;
    f.planes = {solid_.facets[ring.facet.index()].plane};
    f.cap_point =
        interior_point({&ring.outline, 1}, plane_of(ring).normal).value_or(ring.outline[0]);
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

  const Building& building_;
  const Solid& solid_;
  Segmentation& out_;
  const Tolerances& tolerances_;
  Work work_;
  detail::FeatureIndex index_;
  PolygonGrid grid_;
  std::vector<CellFacet> home_;     ///< by Polygon::source, invalid where there is none
  std::map<int, FeatureId> owner_;  ///< by Polygon::source: the smallest ring around it so far
  std::map<std::array<long, 3>, std::vector<Told>> told_;  ///< rings by their middle
  std::map<std::tuple<double, double, double>, int> vertex_;
};

}  // namespace

void add_ring_features(const Building& building, const Solid& solid, Segmentation& segmentation,
                       const Tolerances& tolerances, std::int64_t budget) {
  RingWriter(building, solid, segmentation, tolerances, budget).run();
}

Segmentation segment_open(const Solid& open_shell) {
  Segmentation out;
  out.grid_m = open_shell.grid_m;
  out.planes = open_shell.planes;
  out.vertices = open_shell.vertices;
  Cell cell;
  cell.is_convex = false;
  cell.flag = LeafFlag::open;
  cell.node = NodeId{0};
  cell.facets = open_shell.facets;
  out.cells.push_back(std::move(cell));
  CsgNode leaf;
  leaf.cell = CellId{0};
  out.nodes.push_back(std::move(leaf));
  out.root = NodeId{0};
  out.stats.leaves = out.stats.recursions = 1;
  return out;
}

}  // namespace oriel
