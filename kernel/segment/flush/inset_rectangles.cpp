#include "kernel/segment/flush/inset_rectangles.h"

#include "kernel/base/index.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace oriel::detail {

namespace {

/// An edge is along a direction if it is off by no more than this: noise.
constexpr double kTangentOfStraight = 0.0175;  // 1 degree

/// No side is of more edges: that bounds the work at a corner.
constexpr std::size_t kMostPieces = 16;

/// Points, each one edge after the one before.
using PointChain = std::vector<int>;

/// Its sides are of edges of the polygons inside, counter-clockwise.
struct RectangleOfEdges {
  std::array<int, 4> corners{};                   ///< points
  std::array<std::vector<InputEdgeId>, 4> sides;  ///< side i leads from corner i to the next
  double area_m2 = 0;
};

/// How a side ends at a corner: there, or at a corner of another rectangle that is inset; at a
/// corner of the facet; or it goes on to something else.
enum class End { free, at_corner, goes_on };

class RectangleFinder {
 public:
  RectangleFinder(const Subdivisions& subdivisions, const Subdivision& subdivision, Vec3 normal,
                  const Tolerances& tolerances, Work& work)
      : all_(subdivisions),
        subdivision_(subdivision),
        normal_(normal),
        axes_(axes_in(normal)),
        is_level_(length(cross(normal, {0, 0, 1})) < kTangentOfStraight),
        slack_m_(tolerances.weld_m + tolerances.plane_offset_m),
        work_(work) {}

  std::vector<InsetRectangle> run() {
    if (subdivision_.first_polygon == subdivision_.past_polygon) return {};
    collect_edges();
    if (!has_inner_points()) return {};
    if (is_level_) axes_ = axes_of_rim();
    while (take_rectangles()) {
    }
    drop_unsound();
    return joined();
  }

 private:
  struct EdgeAtPoint {
    int to;                 ///< a point
    InputEdgeId edge = {};  ///< of the polygon to the left; invalid where the facet ends
  };
  /// The sides at a corner, as far as they go straight.
  struct CornerChains {
    int corner;
    Vec3 first, second;
    PointChain along, up;
  };
  struct PointOfFacet {
    std::vector<EdgeAtPoint> spokes;
    bool is_inner = true;   ///< polygons all around it
    bool is_needed = true;  ///< the facet's outline turns there
    int taken = 0;          ///< how many rectangles have a corner here
  };

  [[nodiscard]] Vec3 position(int p) const { return all_.points[at(p)]; }
  [[nodiscard]] Vec3 vector(int p, int q) const { return position(q) - position(p); }
  [[nodiscard]] PointOfFacet& point(int p) { return points_[at(p - first_point_)]; }
  [[nodiscard]] const PointOfFacet& point(int p) const { return points_[at(p - first_point_)]; }

  void collect_edges() {
    const InputPolygonId last{subdivision_.past_polygon.value - 1};
    const auto edges = ids_between(all_.polygons[subdivision_.first_polygon].first_edge,
                                   all_.polygons[last].past_edge);
    int last_point = -1;
    first_point_ = all_.edges[*edges.begin()].from;
    for (const InputEdgeId e : edges) {
      first_point_ = std::min(first_point_, all_.edges[e].from);
      last_point = std::max(last_point, all_.edges[e].from);
    }
    points_.resize(at(last_point - first_point_ + 1));
    for (const InputEdgeId e : edges) {
      const int from = all_.edges[e].from, to = all_.to(e);
      point(from).spokes.push_back({to, e});
      if (all_.edges[e].twin.is_valid()) continue;
      point(to).spokes.push_back({from});
      point(from).is_inner = point(to).is_inner = false;
    }
    for (int p = first_point_; p <= last_point; ++p) point(p).is_needed = is_needed(p);
  }

  /// Those of the longest edge of the rim: level is nothing in a level plane.
  [[nodiscard]] ReachAxes axes_of_rim() const {
    Vec3 longest;
    for (int p = first_point_; p < first_point_ + std::ssize(points_); ++p)
      for (const EdgeAtPoint& spoke : point(p).spokes)
        if (!spoke.edge.is_valid() && length(vector(p, spoke.to)) > length(longest))
          longest = vector(p, spoke.to);
    const Vec3 u = normalised(longest);
    return {u, cross(normal_, u)};
  }

  [[nodiscard]] bool has_inner_points() const {
    return std::ranges::count_if(
               points_, [](const PointOfFacet& p) { return p.is_inner && !p.spokes.empty(); }) >= 2;
  }

  [[nodiscard]] bool is_needed(int p) const {
    if (point(p).is_inner) return false;
    std::vector<Vec3> out;
    for (const EdgeAtPoint& spoke : point(p).spokes)
      if (!spoke.edge.is_valid() || !all_.edges[spoke.edge].twin.is_valid())
        out.push_back(vector(p, spoke.to));
    return out.size() != 2 || !is_along(-1 * out[0], normalised(out[1]));
  }

  /// Straight on along a unit vector.
  [[nodiscard]] bool is_along(Vec3 v, Vec3 direction) const {
    const double along = dot(v, direction);
    return along > 0 &&
           length(cross(v, direction)) <= std::max(slack_m_, along * kTangentOfStraight);
  }

  /// The neighbour straight ahead, or -1: the next one of those that are on the line (slivers have
  /// edges past it), else the one that is off by the least.
  [[nodiscard]] int ahead(int p, Vec3 direction) const {
    int best = -1;
    std::pair<bool, double> least;
    work_.add(std::ssize(point(p).spokes));
    for (const EdgeAtPoint& spoke : point(p).spokes) {
      const Vec3 v = vector(p, spoke.to);
      if (!is_along(v, direction)) continue;
      const double off_m = length(cross(v, direction));
      const bool is_off = off_m > slack_m_;
      const std::pair rank{is_off, is_off ? off_m / length(v) : length(v)};
      if (best >= 0 && rank >= least) continue;
      least = rank;
      best = spoke.to;
    }
    return best;
  }

  /// From a point towards a direction, and on as long as it goes straight; without the point.
  [[nodiscard]] PointChain side(int p, Vec3 direction) const {
    PointChain chain;
    int next = ahead(p, direction);
    if (next < 0) return chain;
    const Vec3 straight = normalised(vector(p, next));
    for (; next >= 0 && chain.size() < kMostPieces; next = ahead(next, straight))
      chain.push_back(next);
    return chain;
  }

  /// Takes what closes at free corners; false if there was nothing new.
  bool take_rectangles() {
    const std::size_t before = taken_.size();
    for (int p = first_point_; p < first_point_ + std::ssize(points_); ++p) {
      if (!point(p).is_inner || point(p).taken > 0 || work_.is_used_up()) continue;
      std::optional<RectangleOfEdges> found;
      for (const Vec3 axis : {axes_.u, axes_.v, -1 * axes_.u, -1 * axes_.v})
        if (const int to = ahead(p, axis); to >= 0 && !found)
          found = at_corner(p, normalised(vector(p, to)));
      if (!found) continue;
      for (const int corner : found->corners) ++point(corner).taken;
      taken_.push_back(std::move(*found));
    }
    return taken_.size() > before && !work_.is_used_up();
  }

  /// The smallest rectangle at a free corner, counter-clockwise from a side.
  [[nodiscard]] std::optional<RectangleOfEdges> at_corner(int p, Vec3 first) const {
    const int last = ahead(p, cross(normal_, first));
    if (last < 0) return std::nullopt;
    const Vec3 second = normalised(vector(p, last));
    const End end = std::max(end_of(p, first), end_of(p, second));
    if (end == End::goes_on) return std::nullopt;
    const CornerChains chains{p, first, second, side(p, first), side(p, second)};
    std::optional<RectangleOfEdges> smallest;
    const std::size_t most = chains.along.size() + chains.up.size();
    for (std::size_t steps = 0; steps < most && !smallest; ++steps)
      smallest = smallest_of(chains, steps);
    if (!smallest || (end != End::free && !has_free_side(*smallest))) return std::nullopt;
    return smallest;
  }

  /// Of the rectangles that take so many steps along both sides beyond the first ones.
  [[nodiscard]] std::optional<RectangleOfEdges> smallest_of(const CornerChains& chains,
                                                            std::size_t steps) const {
    std::optional<RectangleOfEdges> smallest;
    std::size_t along = 0;
    for (std::size_t i = 0; i <= steps; ++i) {
      auto found = closed(chains, i, steps - i);
      if (!found || (smallest && smallest->area_m2 <= found->area_m2)) continue;
      smallest = std::move(found);
      along = i;
    }
    if (!smallest) return std::nullopt;
    const auto grow = [&](std::size_t i, std::size_t j) {
      auto larger = closed(chains, i, j);
      if (larger && goes_on_at_rim(*smallest, *larger)) smallest = std::move(larger);
    };
    for (std::size_t i = along + 1; i < chains.along.size(); ++i) grow(i, steps - along);
    for (std::size_t j = steps - along + 1; j < chains.up.size(); ++j) grow(along, j);
    return smallest;
  }

  /// The rectangle as far as point i along one side and point j along the other.
  [[nodiscard]] std::optional<RectangleOfEdges> closed(const CornerChains& chains, std::size_t i,
                                                       std::size_t j) const {
    if (i >= chains.along.size() || j >= chains.up.size()) return std::nullopt;
    const PointChain across = side(chains.along[i], chains.second),
                     top = side(chains.up[j], chains.first);
    const auto meeting = std::ranges::find_first_of(top, across);
    if (meeting == top.end()) return std::nullopt;
    const auto past = std::ranges::find(across, *meeting) + 1;
    const auto begin = [](const PointChain& chain, std::size_t last) {
      return PointChain(chain.begin(), chain.begin() + offset(last + 1));
    };
    return rectangle({begin(chains.along, i), PointChain(across.begin(), past),
                      backwards(PointChain(top.begin(), meeting + 1), chains.up[j]),
                      backwards(begin(chains.up, j), chains.corner)});
  }

  /// The larger one goes on where the smaller ends, along the rim of the facet on both sides: the
  /// piece of a door between plinths is cut off by an edge of its triangles.
  [[nodiscard]] bool goes_on_at_rim(const RectangleOfEdges& smaller,
                                    const RectangleOfEdges& larger) const {
    const auto is_same = [&](std::size_t s) { return smaller.sides[s] == larger.sides[s]; };
    const auto are_rim = [&](auto first, auto past) {
      return first != past && std::all_of(first, past, [&](InputEdgeId e) {
               return !all_.edges[e].twin.is_valid();
             });
    };
    for (std::size_t s = 0; s < 4; ++s) {
      const std::size_t after = (s + 1) % 4, before = (s + 3) % 4;
      const auto &from = smaller.sides[after], &to = larger.sides[after];
      const auto &back = smaller.sides[before], &longer = larger.sides[before];
      if (is_same(s) && to.size() > from.size() && longer.size() > back.size() &&
          std::equal(from.begin(), from.end(), to.begin()) &&
          std::equal(back.rbegin(), back.rend(), longer.rbegin()) &&
          are_rim(to.begin() + offset(from.size()), to.end()) &&
          are_rim(longer.begin(), longer.end() - offset(back.size())))
        return true;
    }
    return false;
  }

  /// Of the side that leads from a corner into a direction.
  [[nodiscard]] End end_of(int corner, Vec3 inward) const {
    const int beyond = ahead(corner, -1 * inward);
    if (beyond < 0 || point(beyond).taken > 0) return End::free;
    return point(beyond).is_needed ? End::at_corner : End::goes_on;
  }

  [[nodiscard]] End end_of(const RectangleOfEdges& rectangle, std::size_t corner,
                           std::size_t other) const {
    const int p = rectangle.corners[corner % 4], q = rectangle.corners[other % 4];
    if (!point(p).is_inner) return End::at_corner;
    return end_of(p, normalised(vector(p, q)));
  }

  /// A side that goes on at neither end.
  [[nodiscard]] bool has_free_side(const RectangleOfEdges& rectangle) const {
    for (std::size_t s = 0; s < 4; ++s)
      if (end_of(rectangle, s, s + 1) == End::free && end_of(rectangle, s + 1, s) == End::free)
        return true;
    return false;
  }

  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  /// A chain that begins behind `start`, from its end back to `start`.
  static PointChain backwards(PointChain chain, int start) {
    std::ranges::reverse(chain);
    chain.erase(chain.begin());
    chain.push_back(start);
    return chain;
  }

  /// The rectangle of four sides, each the points behind its first one; nothing if it is not within
  /// the facet, or not inset.
  [[nodiscard]] std::optional<RectangleOfEdges> rectangle(
      const std::array<PointChain, 4>& sides) const {
    RectangleOfEdges found;
    Outline outline;
    int from = sides[3].back();
    std::array<bool, 4> begins_inside{}, ends_inside{}, is_inside{};
    for (std::size_t s = 0; s < 4; ++s) {
      found.corners[s] = from;
      is_inside[s] = true;
      for (const int to : sides[s]) {
        const InputEdgeId e = edge_between(from, to);
        if (!e.is_valid()) return std::nullopt;
        ends_inside[s] = all_.edges[e].twin.is_valid();
        if (to == sides[s].front()) begins_inside[s] = ends_inside[s];
        is_inside[s] = is_inside[s] && ends_inside[s];
        found.sides[s].push_back(e);
        outline.push_back(position(from));
        from = to;
      }
    }
    const auto is_middle = [&](std::size_t s) {
      return is_inside[s] && ends_inside[(s + 3) % 4] && begins_inside[(s + 1) % 4] &&
             point(found.corners[s]).is_inner && point(found.corners[(s + 1) % 4]).is_inner;
    };
    const int middles = is_middle(0) + is_middle(1) + is_middle(2) + is_middle(3);
    // Doors reach the rim of their wall; roofs and floors have none.
    if (middles < (is_level_ ? 4 : 1)) return std::nullopt;
    found.area_m2 = signed_area(outline, normal_);
    return found;
  }

  [[nodiscard]] InputEdgeId edge_between(int from, int to) const {
    for (const EdgeAtPoint& spoke : point(from).spokes)
      if (spoke.to == to && spoke.edge.is_valid()) return spoke.edge;
    return {};
  }

  /// Drops what has a side that goes on to nothing that explains it, and then what was explained by
  /// what was dropped.
  void drop_unsound() {
    const auto is_unsound = [&](const RectangleOfEdges& rectangle) {
      for (std::size_t s = 0; s < 4; ++s)
        if (end_of(rectangle, s, s + 1) == End::goes_on ||
            end_of(rectangle, s + 1, s) == End::goes_on)
          return true;
      return false;
    };
    const auto drop = [&](const RectangleOfEdges& rectangle) {
      if (!is_unsound(rectangle)) return false;
      for (const int corner : rectangle.corners) --point(corner).taken;
      return true;
    };
    while (std::erase_if(taken_, drop) > 0) {
    }
  }

  static std::vector<InputEdgeId> ring_of(const RectangleOfEdges& rectangle) {
    std::vector<InputEdgeId> ring;
    for (const auto& side : rectangle.sides) ring.insert(ring.end(), side.begin(), side.end());
    return ring;
  }

  /// What lies within a ring of edges.
  [[nodiscard]] std::vector<InputPolygonId> within(const std::vector<InputEdgeId>& ring) const {
    const std::set<InputEdgeId> barrier(ring.begin(), ring.end());
    std::set<InputPolygonId> found;
    std::vector<InputPolygonId> open;
    const auto enter = [&](InputPolygonId polygon) {
      if (found.insert(polygon).second) open.push_back(polygon);
    };
    for (const InputEdgeId e : ring) enter(all_.edges[e].polygon);
    while (!open.empty()) {
      const SubdivisionPolygon& polygon = all_.polygons[open.back()];
      open.pop_back();
      for (const InputEdgeId e : polygon.edges())
        if (const InputEdgeId twin = all_.edges[e].twin; twin.is_valid() && !barrier.contains(e))
          enter(all_.edges[twin].polygon);
    }
    return {found.begin(), found.end()};
  }

  /// The rectangles, those that share an edge as one.
  [[nodiscard]] std::vector<InsetRectangle> joined() const {
    std::map<InputEdgeId, int> rectangle_of;  // by the edges of rings
    for (int r = 0; r < std::ssize(taken_); ++r)
      for (const InputEdgeId e : ring_of(taken_[at(r)])) rectangle_of[e] = r;
    DisjointSets sets(taken_.size());
    const auto beside = [&](InputEdgeId e) {
      const auto found = rectangle_of.find(all_.edges[e].twin);
      return found == rectangle_of.end() ? -1 : found->second;
    };
    for (const auto& [e, r] : rectangle_of)
      if (beside(e) >= 0) sets.unite(r, beside(e));
    std::map<int, InsetRectangle> joined;
    for (int r = 0; r < std::ssize(taken_); ++r) {
      InsetRectangle& inset = joined[sets.find(r)];
      const std::vector<InputEdgeId> ring = ring_of(taken_[at(r)]);
      for (const InputEdgeId e : ring)
        if (const InputEdgeId twin = all_.edges[e].twin; twin.is_valid() && beside(e) < 0)
          inset.host = all_.edges[twin].polygon;
      const std::vector<InputPolygonId> inside = within(ring);
      inset.polygons.insert(inset.polygons.end(), inside.begin(), inside.end());
    }
    std::vector<InsetRectangle> out;
    for (auto& [r, inset] : joined) {
      std::ranges::sort(inset.polygons);
      inset.polygons.erase(std::unique(inset.polygons.begin(), inset.polygons.end()),
                           inset.polygons.end());
      if (inset.host.is_valid()) out.push_back(std::move(inset));
    }
    return out;
  }

  const Subdivisions& all_;
  const Subdivision& subdivision_;
  Vec3 normal_;
  ReachAxes axes_;
  bool is_level_;
  double slack_m_;
  Work& work_;
  int first_point_ = 0;
  std::vector<PointOfFacet> points_;
  std::vector<RectangleOfEdges> taken_;
};

}  // namespace

std::vector<InsetRectangle> find_inset_rectangles(const Subdivisions& subdivisions,
                                                  const Subdivision& subdivision, Vec3 normal,
                                                  const Tolerances& tolerances, Work& work) {
  return RectangleFinder(subdivisions, subdivision, normal, tolerances, work).run();
}

}  // namespace oriel::detail
