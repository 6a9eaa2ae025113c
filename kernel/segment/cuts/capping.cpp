#include "kernel/segment/cuts/capping.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace oriel::detail {

namespace {

/// On which side of the corner that the planes of a cut make something lies.
enum class CornerKind {
  convex_outside,  ///< outside of it: a chimney on a ridge; the rest is inside
  convex_inside,   ///< inside of it: a hole in an edge
  concave,         ///< in front of all planes: a post in an inner corner
  stepped          ///< neither: planes meet by turns inward and outward, as a wall and a plinth do
};

/// Two points, by their distances from a plane in ranks, lie on different sides of it.
bool are_opposite(int p, int q) { return ((p > 0) & (q < 0)) | ((p < 0) & (q > 0)); }

/// Caps for one component, or nothing.
class Capper {
 public:
  Capper(const Boundary& body, const Component& component, CornerKind corner)
      : body_(body), world_(body.world()), component_(component), corner_(corner) {
    labels_.reserve(component.rim.size());
    for (const EdgeId e : component.rim) labels_.push_back(rim_side(body, component.sides, e));
  }

  std::optional<std::vector<CutCap>> run() {
    if (!order_rim()) return std::nullopt;
    std::vector<CutCap> caps;
    caps.reserve(component_.sides.size());
    for (const PlaneSide side : component_.sides) {
      auto cap = cap_on(side);
      if (!cap) return std::nullopt;
      caps.push_back(std::move(*cap));
    }
    return caps;
  }

 private:
  /// A half-edge of the rim by its place there.
  using RimPlace = std::size_t;
  /// The edges of a loop are mostly no more.
  static constexpr std::size_t kMostly = 8;

  /// Where the rim changes from one plane to another.
  struct RimSwitch {
    PointId point;
    PlaneSide from, to;
    RimPlace rim;  ///< the first half-edge behind it
    /// Where the edge between the facets beyond the rim begins that ends here; invalid: there is
    /// none.
    PointId edge_from = {};
  };

  /// The rim half-edge that follows each on its closed curve.
  bool order_rim() {
    StampMap<EdgeId>& places = world_.scratch.place_in_rim;
    places.start(body_.half_edge_count());
    for (RimPlace i = 0; i < component_.rim.size(); ++i)
      places.set(component_.rim[i], static_cast<int>(i));
    followers_.reserve(component_.rim.size());
    for (RimPlace i = 0; i < component_.rim.size(); ++i) {
      EdgeId follower = body_.next(component_.rim[i]);
      for (int steps = 0; places.find(follower) < 0; ++steps) {
        if (steps > body_.half_edge_count()) return false;
        follower = body_.next(body_.twin(follower));
      }
      const auto place = static_cast<RimPlace>(places.find(follower));
      followers_.push_back(place);
      if (labels_[i] != labels_[place])
        switches_.push_back({body_.origin(follower), labels_[i], labels_[place], place,
                             edge_beyond(component_.rim[i], labels_[place])});
    }
    return true;
  }

  /// Where the edge begins that comes to the end of a rim half-edge between the facet beyond it and
  /// one on `to`.
  [[nodiscard]] PointId edge_beyond(EdgeId rim, PlaneSide to) const {
    const EdgeId edge = body_.prev(body_.twin(rim));
    return body_.side_of_edge(body_.twin(edge)) == to ? body_.origin(edge) : PointId{};
  }

  std::optional<CutCap> cap_on(PlaneSide side) {
    CutCap cap{side, {}, {}, false};
    if (side == component_.ground) {
      cap.side = side ^ 1;
      cap.is_taken = true;
    }
    boost::container::small_vector<char, 32> is_done(labels_.size(), 0);
    for (RimPlace start = 0; start < labels_.size(); ++start) {
      if (labels_[start] != side || is_done[start] != 0) continue;
      CapLoop loop;
      loop.edges.reserve(kMostly);
      RimPlace i = start;
      do {
        is_done[i] = 1;
        const EdgeId e = component_.rim[i];
        loop.edges.push_back({e, body_.origin(e), body_.target(e)});
        i = followers_[i];
        if (labels_[i] == side) continue;
        const auto back = walk_in_the_open(side, labels_[i], body_.target(e), loop);
        if (!back || loop.edges.size() > at(body_.half_edge_count())) return std::nullopt;
        i = *back;
      } while (i != start && is_done[i] == 0);
      if (i != start) return std::nullopt;
      cap.loops.push_back(std::move(loop));
    }
    return cap;
  }

  /// From `point`, where the rim leaves the plane of `side` for that of `other`, along the edges of
  /// the corner to where the rim comes back to `side`: adds the free edges, returns the rim
  /// half-edge there.
  std::optional<RimPlace> walk_in_the_open(PlaneSide side, PlaneSide other, PointId point,
                                           CapLoop& loop) {
    for (int steps = 0; steps <= 4; ++steps) {
      const auto stop = next_stop(side, other, point);
      if (!stop) return std::nullopt;
      loop.edges.push_back({EdgeId{}, point, stop->point});
      if (stop->rim) return stop->rim;
      point = stop->point;
      other = stop->other;
    }
    return std::nullopt;
  }

  struct WalkStop {
    PointId point;
    std::optional<RimPlace> rim;  ///< where the rim takes over
    PlaneSide other;              ///< the plane to walk along next, if it does not
  };

  /// From the caps `side` and `other` towards the inside of the corner's edge between them.
  [[nodiscard]] Vec3 ahead(PlaneSide side, PlaneSide other) const {
    const Vec3 line = cross(world_.planes.normal(side), world_.planes.normal(other));
    const bool is_at_ground = side == component_.ground || other == component_.ground;
    return corner_ == CornerKind::concave && !is_at_ground ? -line : line;
  }

  /// The nearest point ahead on the line in which two planes meet: where the rim comes from `other`
  /// to `side`, or where a third plane of the corner meets them.
  std::optional<WalkStop> next_stop(PlaneSide side, PlaneSide other, PointId point) {
    if (corner_ == CornerKind::stepped) return next_stop_of_step(side, other, point);
    const Vec3 direction = ahead(side, other);
    const double here = dot(direction, world_.points.at(point));
    std::optional<WalkStop> nearest;
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](const WalkStop& stop) {
      const double distance = dot(direction, world_.points.at(stop.point)) - here;
      if (stop.point == point || distance <= 0 || distance > least) return;
      // Where several planes meet, the walk goes on along the one that bounds the corner.
      if (distance == least && (!stop.rim && !bounds_corner(side, stop))) return;
      least = distance;
      nearest = stop;
    };
    for (const PlaneSide third : component_.sides) {
      if (third == side || third == other) continue;
      const auto meeting = world_.points.meet(side >> 1, other >> 1, third >> 1);
      if (meeting && is_on_corner(*meeting)) offer({*meeting, std::nullopt, third});
    }
    for (const RimSwitch& s : switches_)
      if (s.from == other && s.to == side) offer({s.point, s.rim, other});
    return nearest;
  }

  /// In steps the walk goes on as the edge of the rest did that came to the point, up to where the
  /// rim comes back.
  [[nodiscard]] std::optional<WalkStop> next_stop_of_step(PlaneSide side, PlaneSide other,
                                                          PointId point) const {
    const auto start = std::ranges::find_if(switches_, [&](const RimSwitch& s) {
      return s.point == point && s.from == side && s.to == other;
    });
    if (start == switches_.end() || !start->edge_from.is_valid()) return std::nullopt;
    const Vec3 here = world_.points.at(point);
    const Vec3 direction = here - world_.points.at(start->edge_from);
    std::optional<WalkStop> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const RimSwitch& s : switches_) {
      if (s.from != other || s.to != side || s.point == point) continue;
      const double distance = dot(direction, world_.points.at(s.point) - here);
      if (distance <= 0 || distance >= least) continue;
      least = distance;
      nearest = {s.point, s.rim, other};
    }
    return nearest;
  }

  /// The edge between `side` and the stop's plane leads from the stop along the corner, not out of
  /// it.
  [[nodiscard]] bool bounds_corner(PlaneSide side, const WalkStop& stop) {
    const Vec3 direction = ahead(side, stop.other);
    return std::ranges::all_of(component_.sides, [&](PlaneSide s) {
      if (s == side || s == stop.other || world_.points.side(stop.point, s >> 1) != 0) return true;
      const double out = dot(world_.planes.normal(s), direction);
      return corner_ == CornerKind::concave && s != component_.ground ? out >= 0 : out <= 0;
    });
  }

  [[nodiscard]] bool is_on_corner(PointId point) {
    return std::ranges::all_of(component_.sides, [&](PlaneSide side) {
      const int level = world_.points.level(point, side);
      return corner_ == CornerKind::concave && side != component_.ground ? level >= 0 : level <= 0;
    });
  }

  const Boundary& body_;
  World& world_;
  const Component& component_;
  CornerKind corner_;
  boost::container::small_vector<PlaneSide, 16>
      labels_;  ///< by place in the rim: the plane of the cap there
  boost::container::small_vector<RimPlace, 16> followers_;  ///< likewise
  boost::container::small_vector<RimSwitch, 8> switches_;
};

/// Tells whether a component and its caps make a patch, and measures it.
class PatchJudge {
 public:
  PatchJudge(FlatBody& flat, bool is_hole)
      : flat_(flat), body_(flat.body()), world_(flat.body().world()), is_hole_(is_hole) {}

  std::optional<Patch> run(const Component& component) {
    const auto corner = is_stepped(component) ? CornerKind::stepped : corner_of(component);
    if (!corner) return std::nullopt;
    auto caps = Capper(body_, component, *corner).run();
    if (!caps) return std::nullopt;
    Patch patch{is_hole_, component.facets, std::move(*caps)};
    if (corner == CornerKind::stepped && !are_edges_paired(patch)) return std::nullopt;
    if (!measure(patch) || !are_edges_free(patch) || is_pierced(patch)) return std::nullopt;
    return patch;
  }

 private:
  /// A side as all points are asked about it.
  struct SideLimit {
    PointRanks ranks;
    int rank, direction;
    /// As PointTable::level.
    [[nodiscard]] int level(PointId point) const {
      const int difference = ranks[point] - rank;
      return ((difference > 0) - (difference < 0)) * direction;
    }
  };

  /// Two of its planes have one normal.
  [[nodiscard]] bool is_stepped(const Component& component) const {
    const auto& sides = component.sides;
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if ((sides[i] & 1) == (sides[j] & 1) &&
            world_.planes.class_of(sides[i] >> 1) == world_.planes.class_of(sides[j] >> 1))
          return true;
    return false;
  }

  /// The caps meet in each of their free edges.
  [[nodiscard]] static bool are_edges_paired(const Patch& patch) {
    std::vector<std::pair<PointId, PointId>> ahead, back;
    for (const CutCap& cap : patch.caps)
      for (const CapLoop& loop : cap.loops)
        for (const CapEdge& edge : loop.edges) {
          if (edge.rim.is_valid()) continue;
          ahead.emplace_back(edge.from, edge.to);
          back.emplace_back(edge.to, edge.from);
        }
    std::ranges::sort(ahead);
    std::ranges::sort(back);
    return ahead == back;
  }

  /// Those of a component, without the ground.
  [[nodiscard]] boost::container::small_vector<SideLimit, 4> limits_of(
      const Component& component) const {
    boost::container::small_vector<SideLimit, 4> limits;
    for (const PlaneSide side : component.sides)
      if (side != component.ground)
        limits.push_back({world_.points.ranks(world_.planes.class_of(side >> 1)),
                          world_.planes.rank_of(side >> 1), (side & 1) != 0 ? -1 : 1});
    return limits;
  }

  [[nodiscard]] std::optional<CornerKind> corner_of(const Component& component) const {
    bool is_behind_all = is_hole_, is_before_all = !is_hole_, is_before_one = !is_hole_;
    const auto limits = limits_of(component);
    StampSet<PointId>& met = world_.scratch.met_points;
    met.start(world_.points.size());
    for (const BodyFacetId f : component.facets) {
      body_.for_each_edge(f, [&](EdgeId e) {
        world_.work.add(std::ssize(component.sides));
        if (!met.insert(body_.origin(e))) return;
        int most = -1, least = 1;
        for (const SideLimit& limit : limits) {
          const int level = limit.level(body_.origin(e));
          most = std::max(most, level);
          least = std::min(least, level);
        }
        is_behind_all &= most <= 0;
        is_before_all &= least >= 0;
        is_before_one &= most >= 0;
      });
      if (!is_behind_all && !is_before_all && !is_before_one) return std::nullopt;
    }
    if (is_behind_all) return CornerKind::convex_inside;
    return is_before_all ? CornerKind::concave : CornerKind::convex_outside;
  }

  /// No facet outside the patch stands in the way of a free edge.
  [[nodiscard]] bool are_edges_free(const Patch& patch) const {
    for (const CutCap& cap : patch.caps)
      for (const CapLoop& loop : cap.loops)
        for (const CapEdge& edge : loop.edges)
          if (!edge.rim.is_valid() && edge.from < edge.to && is_crossed(edge.from, edge.to))
            return false;
    return true;
  }

  [[nodiscard]] bool is_crossed(PointId from, PointId to) const {
    const Vec3 p = world_.points.at(from), q = world_.points.at(to);
    for (const FlatBody::RankedFacet& f : flat_.facets()) {
      const int start = world_.points.rank(from, f.normal_class) - f.rank,
                end = world_.points.rank(to, f.normal_class) - f.rank;
      if (!are_opposite(start, end)) continue;
      const PlaneSide side = body_.facet(f.number).side;
      const Vec3 normal = world_.planes.normal(side);
      const double offset_m = world_.planes.offset_m(side);
      const double hp = dot(normal, p) - offset_m, hq = dot(normal, q) - offset_m;
      if (contains_clearly(body_.outlines(f.number), normal, p + (hp / (hp - hq)) * (q - p),
                           world_.points.grid_m()))
        return true;
    }
    return false;
  }

  /// An edge of the body goes through a cap that is none of its facets.
  [[nodiscard]] bool is_pierced(const Patch& patch) const {
    return std::ranges::any_of(patch.caps,
                               [&](const CutCap& cap) { return !cap.is_taken && is_pierced(cap); });
  }

  [[nodiscard]] bool is_pierced(const CutCap& cap) const {
    const Vec3 normal = world_.planes.normal(cap.side);
    const double offset_m = world_.planes.offset_m(cap.side);
    const auto ranks = world_.points.ranks(world_.planes.class_of(cap.side >> 1));
    const int rank = world_.planes.rank_of(cap.side >> 1);
    std::vector<Outline> shape;
    for (const auto& [first, second] : flat_.edges()) {
      const int start = ranks[first] - rank, end = ranks[second] - rank;
      if (!are_opposite(start, end)) continue;
      const Vec3 p = world_.points.at(start > 0 ? first : second),
                 q = world_.points.at(start > 0 ? second : first);
      const double hp = dot(normal, p) - offset_m, hq = dot(normal, q) - offset_m;
      if (shape.empty()) shape = shape_of(cap);
      if (contains_clearly(shape, normal, p + (hp / (hp - hq)) * (q - p), world_.points.grid_m()))
        return true;
    }
    return false;
  }

  [[nodiscard]] std::vector<Outline> shape_of(const CutCap& cap) const {
    std::vector<Outline> shape;
    for (const CapLoop& loop : cap.loops) {
      shape.emplace_back();
      for (const CapEdge& edge : loop.edges) shape.back().push_back(world_.points.at(edge.from));
    }
    return shape;
  }

  /// Fills in areas and volume, takes covered facets off the caps; false if a cap has no area, or
  /// the patch no volume.
  bool measure(Patch& patch) const {
    double patch_sum = 0, cap_sum = 0;
    for (const BodyFacetId f : patch.facets)
      patch_sum += world_.planes.offset_m(body_.facet(f).side) * body_.area(f);
    for (CutCap& cap : patch.caps) {
      const std::vector<Outline> shape = shape_of(cap);
      const Vec3 normal = world_.planes.normal(cap.side);
      double area = 0;
      for (const Outline& outline : shape) area += signed_area(outline, normal);
      cap_sum += world_.planes.offset_m(cap.side) * area;
      if (cap.is_taken) continue;
      for (const BodyFacetId g : body_.facets_on(cap.side ^ 1)) {
        if (std::ranges::binary_search(patch.facets, g)) continue;
        const auto inside = interior_point(body_.outlines(g), normal);
        if (!inside || !contains(shape, normal, *inside)) continue;
        cap.covered.push_back(g);
        area -= body_.area(g);
      }
      if (area <= 0) return false;
      patch.new_area += area;
      patch.old_area += body_.area_on(cap.side);
    }
    // A protrusion's own caps look the other way; a hole's walls do.
    patch.volume = (patch.is_hole ? cap_sum - patch_sum : patch_sum - cap_sum) / 3;
    return patch.volume > 0;
  }

  FlatBody& flat_;
  const Boundary& body_;
  World& world_;
  bool is_hole_;
};

}  // namespace

std::vector<PlaneSide> Patch::sides() const {
  std::vector<PlaneSide> sides;
  for (const CutCap& cap : caps)
    if (!cap.is_taken) sides.push_back(cap.side);
  std::ranges::sort(sides);
  return sides;
}

PlaneSide rim_side(const Boundary& body, std::span<const PlaneSide> sides, EdgeId e) {
  const PlaneSide beyond = body.side_of_edge(body.twin(e));
  if (std::ranges::binary_search(sides, beyond)) return beyond;
  auto& points = body.world().points;
  for (const PlaneSide side : sides)
    if (points.side(body.origin(e), side >> 1) == 0 && points.side(body.target(e), side >> 1) == 0)
      return side;
  return -1;
}

std::optional<Patch> cap_component(FlatBody& body, bool is_hole, const Component& component) {
  PointTable& points = body.body().world().points;
  const PointTable::PointMark before = points.mark();
  auto patch = PatchJudge(body, is_hole).run(component);
  if (!patch) points.forget_since(before);
  return patch;
}

namespace {

/// Normals whose parallelepiped has less volume (or area) tell nothing of each other's caps.
constexpr double kFlat = 1e-3;  // of unit vectors, no tolerance of the model

/// A linear programme: the least is that of up to three caps that alone close the surface.
class LeastCaps {
 public:
  LeastCaps(Vec3 open, double slack) : open_(open), slack_(slack) {
    if (length(open) <= slack) least_ = 0;
  }

  void offer(Vec3 n) {
    const double area = dot(open_, n);
    if (length(open_ - area * n) <= slack_) take(area, 0, 0, 1);
  }

  void offer(Vec3 n, Vec3 m) {
    const double c = dot(n, m), det = 1 - c * c;
    if (det < kFlat) return;
    const double p = dot(open_, n), q = dot(open_, m);
    const double first = (p - c * q) / det, second = (q - c * p) / det;
    if (length(open_ - first * n - second * m) <= slack_) take(first, second, 0, det);
  }

  void offer(Vec3 n, Vec3 m, Vec3 k) {
    const Vec3 across = cross(m, k);
    const double det = dot(n, across);
    if (std::abs(det) < kFlat) return;
    take(dot(open_, across) / det, dot(open_, cross(k, n)) / det, dot(open_, cross(n, m)) / det,
         std::abs(det));
  }

  [[nodiscard]] double least() const { return least_; }

 private:
  void take(double first, double second, double third, double det) {
    if (std::min({first, second, third}) < -slack_ / det) return;
    least_ = std::min(least_, std::max(first, 0.0) + std::max(second, 0.0) + std::max(third, 0.0));
  }

  Vec3 open_;
  double slack_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

double least_cap_area(std::span<const Vec3> normals, Vec3 open, double slack_m2) {
  LeastCaps caps(open, slack_m2);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    caps.offer(normals[i]);
    for (std::size_t j = 0; j < i; ++j) {
      caps.offer(normals[i], normals[j]);
      for (std::size_t k = 0; k < j; ++k) caps.offer(normals[i], normals[j], normals[k]);
    }
  }
  return caps.least();
}

}  // namespace oriel::detail
