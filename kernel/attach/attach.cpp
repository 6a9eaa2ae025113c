#include "kernel/attach/attach.h"

#include "kernel/attach/clearance.h"
#include "kernel/attach/new_facet.h"
#include "kernel/base/assert.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "model/solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

/// The boundary of a bounded convex body.
struct ConvexBody {
  struct Corner {
    exact::Rational point;
    std::array<int, 3> planes{};  ///< ascending
  };
  std::vector<Corner> corners;
  /// For each plane its facet, counter-clockwise seen from outside; empty if the plane does not
  /// touch the body.
  std::vector<Loop> loops;
};

/// False if four planes meet in a corner.
bool find_corners(const std::vector<Plane>& planes, ConvexBody& body) {
  const int count = static_cast<int>(planes.size());
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      for (int k = j + 1; k < count; ++k) {
        const auto point = exact::meet(planes[at(i)], planes[at(j)], planes[at(k)]);
        if (!point) continue;
        bool is_corner = true, is_crowded = false;
        for (int other = 0; other < count && is_corner; ++other) {
          if (other == i || other == j || other == k) continue;
          const int side = exact::side(planes[at(other)], *point);
          is_corner = side <= 0;
          is_crowded = is_crowded || side == 0;
        }
        if (!is_corner) continue;
        if (is_crowded) return false;
        body.corners.push_back({*point, {i, j, k}});
      }
  return true;
}

/// The corners of a facet in turn: neighbours share a second plane. Empty if they do not close.
Loop ring_of(const ConvexBody& body, int plane) {
  Loop all;
  for (int c = 0; c < std::ssize(body.corners); ++c)
    if (std::ranges::find(body.corners[at(c)].planes, plane) != body.corners[at(c)].planes.end())
      all.push_back(c);
  if (all.size() < 3) return {};
  Loop ring{all.front()};
  int across = -1;  // the plane along which the ring came
  while (true) {
    const auto& here = body.corners[at(ring.back())].planes;
    int next_across = -1, next = -1;
    for (const int p : here)
      if (p != plane && p != across) next_across = p;
    for (const int c : all)
      if (c != ring.back() && std::ranges::find(body.corners[at(c)].planes, next_across) !=
                                  body.corners[at(c)].planes.end())
        next = c;
    if (next < 0 || ring.size() > all.size()) return {};
    if (next == ring.front()) break;
    ring.push_back(next);
    across = next_across;
  }
  return ring.size() == all.size() ? ring : Loop{};
}

/// Counter-clockwise about the normal: the sign of one exact turn of a convex ring.
bool is_clockwise(const ConvexBody& body, const Loop& ring, const Plane& plane) {
  std::array<Vec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i)
    p.at(i) = exact::to_metres(body.corners[at(ring[i])].point, 1);
  return dot(cross(p[1] - p[0], p[2] - p[1]), plane.normal) < 0;
}

/// What lies behind all planes. Nothing if that is empty or not bounded, or if four planes meet in
/// one of its corners. Exact; takes time n⁴ in the number of planes, which are few.
std::optional<ConvexBody> convex_body(const std::vector<Plane>& planes) {
  ConvexBody body;
  if (!find_corners(planes, body) || body.corners.size() < 4) return std::nullopt;
  std::size_t sides = 0;
  for (int p = 0; p < std::ssize(planes); ++p) {
    Loop ring = ring_of(body, p);
    const bool touches = std::ranges::any_of(body.corners, [&](const auto& corner) {
      return std::ranges::find(corner.planes, p) != corner.planes.end();
    });
    if (ring.empty() && touches) return std::nullopt;
    if (!ring.empty() && is_clockwise(body, ring, planes[at(p)])) std::ranges::reverse(ring);
    sides += ring.size();
    body.loops.push_back(std::move(ring));
  }
  // Each corner has three facets, and by Euler a closed body has no other number of them.
  const auto facets = static_cast<std::size_t>(
      std::ranges::count_if(body.loops, [](const Loop& loop) { return !loop.empty(); }));
  if (sides != 3 * body.corners.size() || body.corners.size() + facets != sides / 2 + 2)
    return std::nullopt;
  return body;
}

}  // namespace

}  // namespace oriel::detail

namespace oriel {

namespace {

/// So much of a distance is looked at that what lies just at it does not count.
constexpr double kNearly = 0.999;

using LineSegment = std::pair<Vec3, Vec3>;

class Attacher {
 public:
  Attacher(const Solid& solid, std::vector<FacetId> contacts, const std::vector<Plane>& planes,
           Attach kind, const Clearance& clearance, Solid* spare)
      : solid_(solid),
        contacts_(std::move(contacts)),
        kind_(kind),
        clearance_(clearance),
        spare_(spare) {
    ORIEL_ASSERT(spare == nullptr || spare == &solid);
    clearance_.least_m = std::max(clearance.least_m, kLeastEdge_m);
    for (const FacetId own : clearance_.own)
      for_each_edge(own, [this](int a, int b) { own_edges_.emplace(b, a); });
    const Plane& first = plane_of(contacts_[0]);
    planes_.push_back(kind == Attach::raise ? exact::opposite(first) : first);
    if (contacts_.size() == 2) {
      const Plane& second = plane_of(contacts_[1]);
      planes_.push_back(is_before_second() ? exact::opposite(second) : second);
    }
    planes_.insert(planes_.end(), planes.begin(), planes.end());
  }

  Attached run() {
    if (const char* reason = why_not()) return {std::nullopt, {}, reason};
    Attached out;
    if (spare_ != nullptr)
      out.solid = std::move(*spare_);
    else
      out.solid = solid_;
    add_vertices(*out.solid);
    for (int p = static_cast<int>(contacts_.size()); p < std::ssize(planes_); ++p)
      if (!body_.loops[at(p)].empty()) add_facet(p, out);
    if (contacts_.size() == 1)
      out.solid->facets[contacts_[0].index()].loops.push_back(of_solid(outline(0)));
    else
      for (int c = 0; c < 2; ++c) cut_notch(c, *out.solid);
    return out;
  }

 private:
  [[nodiscard]] const Facet& facet(FacetId id) const { return solid_.facets[id.index()]; }
  [[nodiscard]] const Plane& plane_of(FacetId id) const {
    return solid_.planes[facet(id).plane.index()];
  }
  [[nodiscard]] Vec3 corner(int c) const { return points_[at(c)]; }

  /// The first contact rises in front of the second one (a wall on a slab), not behind it.
  [[nodiscard]] bool is_before_second() const {
    double side = 0;
    for_each_shared_edge([&](int a, int b) {
      const Vec3 along = solid_.vertices[at(b)].point - solid_.vertices[at(a)].point;
      side += dot(cross(plane_of(contacts_[0]).normal, along), plane_of(contacts_[1]).normal);
    });
    return side > 0;
  }
  /// The second contact takes a part of the body's outline in, which it does not have yet.
  [[nodiscard]] bool gets_tab() const { return is_before_second() == (kind_ == Attach::sink); }
  template <class Visit>
  void for_each_shared_edge(Visit visit) const {
    std::vector<std::pair<int, int>> of_second;
    for_each_edge(contacts_[1], [&](int a, int b) { of_second.emplace_back(b, a); });
    for_each_edge(contacts_[0], [&](int a, int b) {
      if (std::ranges::find(of_second, std::pair{a, b}) != of_second.end()) visit(a, b);
    });
  }

  const char* why_not() {
    const auto body = detail::convex_body(planes_);
    if (!body) return "the body is empty or degenerate";
    body_ = *body;
    for (const auto& found : body_.corners)
      points_.push_back(exact::to_metres(found.point, solid_.grid_m));
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      if (body_.loops[c].empty()) return "the body does not touch the facet";
    if (contacts_.size() == 2 && !find_notch()) return "the two facets share no edge there";
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      if (!is_inside(c)) return "its outline does not fit into the facet";
    if (meets_others()) return "it would come too near to another part";
    return nullptr;
  }

  /// The body's outline on a contact as a hole of it: clockwise seen from outside the solid.
  [[nodiscard]] Loop outline(std::size_t contact) const {
    Loop loop = body_.loops[contact];
    if (kind_ == Attach::sink) std::ranges::reverse(loop);
    return loop;
  }

  [[nodiscard]] Loop of_solid(Loop loop) const {
    for (int& c : loop) c += first_vertex_;
    return loop;
  }

  /// The edge of the body that lies in both contacts, and the edge of the solid it lies on.
  bool find_notch() {
    const Loop& loop = body_.loops[0];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int p = loop[i], q = loop[(i + 1) % loop.size()];
      if (is_on_second(p) && is_on_second(q)) notch_ = {p, q};
    }
    if (notch_.first < 0) return false;
    for_each_shared_edge([&](int a, int b) {
      const Vec3 from = solid_.vertices[at(a)].point, to = solid_.vertices[at(b)].point;
      const Vec3 along = normalised(to - from);
      const auto fits = [&](int c) {
        const double s = dot(corner(c) - from, along);
        return s >= kLeastEdge_m && s <= length(to - from) - kLeastEdge_m &&
               length(corner(c) - from - s * along) < kLeastEdge_m;
      };
      const bool is_within = fits(notch_.first) && fits(notch_.second);
      if (!is_within && !(gets_tab() && is_spanned(from, to))) return;
      is_wide_ = !is_within;
      edge_ = {a, b};
      if (dot(corner(notch_.second) - corner(notch_.first), along) < 0)
        std::swap(notch_.first, notch_.second);
    });
    return edge_.first >= 0;
  }
  /// The edge of the body in both contacts reaches past a segment at both of its ends.
  [[nodiscard]] bool is_spanned(Vec3 from, Vec3 to) const {
    const Vec3 p = corner(notch_.first), along = normalised(corner(notch_.second) - p);
    const double length_m = length(corner(notch_.second) - p);
    return std::ranges::all_of(std::array{from, to}, [&](Vec3 end) {
      const double s = dot(end - p, along);
      return s >= kLeastEdge_m && s <= length_m - kLeastEdge_m &&
             length(end - p - s * along) < kLeastEdge_m;
    });
  }
  [[nodiscard]] bool is_on_second(int c) const {
    return std::ranges::find(body_.loops[1], c) != body_.loops[1].end();
  }

  template <class Visit>
  void for_each_edge(FacetId id, Visit visit) const {
    for (const Loop& loop : facet(id).loops)
      for (std::size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[(i + 1) % loop.size()]);
  }

  /// The outline lies in the facet and off its edges; where a notch is cut it touches one of them,
  /// and a tab lies outside.
  [[nodiscard]] bool is_inside(std::size_t contact) const {
    const Vec3 normal = solid_.planes[facet(contacts_[contact]).plane.index()].normal;
    const auto outlines = outlines_of(solid_.vertices, facet(contacts_[contact]).loops);
    const Loop& loop = body_.loops[contact];
    bool is_clear = true;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int p = loop[i], q = loop[(i + 1) % loop.size()];
      const bool is_outside = contact == 1 && gets_tab();
      const bool is_at_edge = is_of_notch(p) && !(is_wide_ && contact == 0);
      if (!is_at_edge && contains(outlines, normal, corner(p)) == is_outside) return false;
      if (is_of_notch(p) && is_of_notch(q)) continue;
      for_each_edge(contacts_[contact], [&](int a, int b) {
        // The edge that is cut is the body's own: its height or depth lies between.
        if (std::pair{a, b} == edge_ || std::pair{b, a} == edge_) return;
        is_clear = is_clear && keeps_off({corner(p), corner(q)}, a, b);
      });
    }
    if (is_wide_ && contact == 0) is_clear = is_clear && has_clear_ends();
    // A hole of the facet may lie inside the outline.
    Outline mine;
    for (const int c : loop) mine.push_back(corner(c));
    const std::array<Outline, 1> only{mine};
    for (std::size_t o = 0; o < outlines.size(); ++o)
      if (!(is_wide_ && has_cut_edge(facet(contacts_[contact]).loops[o])) &&
          contains(only, normal, outlines[o][0]))
        return false;
    return is_clear;
  }
  /// What is longer than the edge that it shares: beside the ends of that edge.
  [[nodiscard]] bool has_clear_ends() const {
    const auto [a, b] = edge_;
    const LineSegment first{corner(notch_.first), solid_.vertices[at(a)].point};
    const LineSegment second{corner(notch_.second), solid_.vertices[at(b)].point};
    bool is_clear = true;
    for_each_edge(contacts_[0], [&](int v, int w) {
      if (v == a || v == b || w == a || w == b) return;
      is_clear = is_clear && keeps_off(first, v, w) && keeps_off(second, v, w);
    });
    return is_clear;
  }
  [[nodiscard]] bool has_cut_edge(const Loop& loop) const {
    return std::ranges::find(loop, edge_.first) != loop.end();
  }
  /// A segment keeps its distance from an edge of a contact.
  [[nodiscard]] bool keeps_off(const LineSegment& mine, int a, int b) const {
    const LineSegment edge{solid_.vertices[at(a)].point, solid_.vertices[at(b)].point};
    if (own_edges_.contains({a, b})) return distance(mine, edge) >= kLeastEdge_m;
    return is_far_off(mine, edge) || !is_too_near(clearance_, distance(mine, edge), edge);
  }
  /// Their boxes are further apart than the clearance: their distance need not be known.
  [[nodiscard]] bool is_far_off(const LineSegment& p, const LineSegment& q) const {
    const double reach_m = 2 * clearance_.least_m;
    const auto are_apart = [&](double a, double b, double c, double d) {
      return std::min(a, b) > std::max(c, d) + reach_m || std::min(c, d) > std::max(a, b) + reach_m;
    };
    return are_apart(p.first.x, p.second.x, q.first.x, q.second.x) ||
           are_apart(p.first.y, p.second.y, q.first.y, q.second.y) ||
           are_apart(p.first.z, p.second.z, q.first.z, q.second.z);
  }
  [[nodiscard]] bool is_of_notch(int c) const { return c == notch_.first || c == notch_.second; }

  /// What lies behind the body's planes, but those of the contacts moved out.
  [[nodiscard]] std::vector<HalfSpaceM> grown_by(double by_m) const {
    std::vector<HalfSpaceM> limits;
    for (std::size_t p = 0; p < planes_.size(); ++p)
      limits.push_back(
          {planes_[p].normal, planes_[p].offset_m + (p < contacts_.size() ? 0 : by_m)});
    return limits;
  }

  /// Another facet has a part in the body grown by the distance, but not beyond the contacts.
  [[nodiscard]] bool meets_others() const {
    const auto limits = grown_by(kNearly * clearance_.least_m);
    Box box;
    for (const Vec3 p : points_) box.grow(p);
    const double reach_m =
        4 * clearance_.least_m;  // corners of sharp bodies grow further than their planes
    for (const FacetId f : ids_below<FacetId>(solid_.facets.size())) {
      if (std::ranges::find(contacts_, f) != contacts_.end()) continue;
      const Facet& other = solid_.facets[f.index()];
      if (is_far(other, box, reach_m)) continue;
      const Vec3 normal = solid_.planes[other.plane.index()].normal;
      if (area_within(solid_.vertices, other, normal, limits) <= kTouch_m2) continue;
      const bool is_own = std::ranges::find(clearance_.own, f) != clearance_.own.end();
      const double near_m = is_own ? 0 : nearest_before(f);
      if (near_m >= clearance_.least_m ||
          area_within(solid_.vertices, other, normal, grown_by(kNearly * near_m)) > kTouch_m2)
        return true;
    }
    return false;
  }
  /// How near what was there before came to a facet; nothing to spare counts as touching.
  [[nodiscard]] double nearest_before(FacetId id) const {
    double near_m = clearance_.least_m;
    for_each_edge(id, [&](int a, int b) {
      near_m = std::min(near_m, needed_m(clearance_, {solid_.vertices[at(a)].point,
                                                      solid_.vertices[at(b)].point}));
    });
    return near_m > kLeastEdge_m ? near_m : 0;
  }

  [[nodiscard]] bool is_far(const Facet& other, const Box& box, double reach_m) const {
    Box its;
    for (const int v : other.loops[0]) its.grow(solid_.vertices[at(v)].point);
    return its.min.x > box.max.x + reach_m || box.min.x > its.max.x + reach_m ||
           its.min.y > box.max.y + reach_m || box.min.y > its.max.y + reach_m ||
           its.min.z > box.max.z + reach_m || box.min.z > its.max.z + reach_m;
  }

  void add_vertices(Solid& solid) {
    first_vertex_ = static_cast<int>(solid.vertices.size());
    for (const Vec3 p : points_) solid.vertices.push_back({p, true});
  }

  void add_facet(int p, Attached& out) const {
    const Plane plane = kind_ == Attach::raise ? planes_[at(p)] : exact::opposite(planes_[at(p)]);
    Loop loop = body_.loops[at(p)];
    if (kind_ == Attach::sink) std::ranges::reverse(loop);
    out.facets.push_back(
        detail::add_facet(*out.solid, plane, of_solid(std::move(loop)), contacts_[0]));
  }

  /// The edge a → b becomes a → p, the outline the long way round, q → b; of the second contact,
  /// whose edge runs the other way, likewise.
  void cut_notch(int contact, Solid& solid) const {
    const auto [a, b] = contact == 0 ? edge_ : std::pair{edge_.second, edge_.first};
    const int from = contact == 0 ? notch_.first : notch_.second;
    const Loop hole = outline(static_cast<std::size_t>(contact));
    // Clockwise, the hole runs from `from` round to the other end of the notch.
    Loop way(hole);
    std::ranges::rotate(way, std::ranges::find(way, from));
    for (Loop& loop : solid.facets[contacts_[at(contact)].index()].loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        if (loop[i] == a && loop[(i + 1) % loop.size()] == b) {
          const Loop added = of_solid(way);
          loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, added.begin(),
                      added.end());
          return;
        }
  }

  const Solid& solid_;
  std::vector<FacetId> contacts_;
  std::vector<Plane> planes_;  ///< out of the body, those of the contacts first
  Attach kind_;
  Clearance clearance_;
  Solid* spare_;  ///< the solid, if it may be taken for the result
  detail::ConvexBody body_;
  std::vector<Vec3> points_;           ///< of the body's corners
  int first_vertex_ = 0;               ///< of the solid, for the body's corners
  std::pair<int, int> notch_{-1, -1};  ///< corners on both contacts, along the first one's edge
  std::pair<int, int> edge_{-1, -1};   ///< the solid's edge they lie on, of the first contact
  bool is_wide_ = false;               ///< the notch is longer than that edge
  std::set<std::pair<int, int>> own_edges_;  ///< of facets beside Clearance::own
};

}  // namespace

Attached attach(const Solid& solid, const std::vector<FacetId>& contacts,
                const std::vector<Plane>& planes, Attach kind, const Clearance& clearance,
                Solid* spare) {
  return Attacher(solid, contacts, planes, kind, clearance, spare).run();
}

Plane plane_through(const Solid& solid, Vec3 direction, Vec3 point, double within_deg) {
  direction = normalised(direction);
  const double least = std::cos(within_deg * std::numbers::pi / 180);
  std::array<std::int64_t, 3> normal{};
  double best = least;
  for (const Plane& plane : solid.planes) {
    const double along = dot(plane.normal, direction);
    if (std::abs(along) < best) continue;
    if (std::abs(along) == best && normal != std::array<std::int64_t, 3>{}) continue;
    best = std::abs(along);
    normal = plane.coefficients;
    if (along < 0)
      for (std::int64_t& c : normal) c = -c;
  }
  if (normal == std::array<std::int64_t, 3>{}) {
    // Directions of drawn walls have seldom more than twenty bits; the rest is rounding.
    constexpr double kScale = 1 << 26;
    const std::array<std::int64_t, 3> rounded{std::llround(direction.x * kScale),
                                              std::llround(direction.y * kScale),
                                              std::llround(direction.z * kScale)};
    normal = exact::direction(rounded).value_or(std::array<std::int64_t, 3>{0, 0, 1});
  }
  const Vec3 n{static_cast<double>(normal[0]), static_cast<double>(normal[1]),
               static_cast<double>(normal[2])};
  return exact::make_plane(normal, std::llround(dot(n, point) / solid.grid_m), solid.grid_m);
}

}  // namespace oriel
