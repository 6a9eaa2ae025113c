#include "kernel/segment/flush/contained_polygons.h"

#include "kernel/base/index.h"
#include "kernel/segment/flush/inset_rectangles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// How far a chain around three sides must turn: two right angles, less what lets the sides lean.
constexpr double kTurn_deg = 150;
/// A chain may turn outward by this much at a vertex and still be straight: noise.
constexpr double kStraight_deg = 1;

/// A cycle of edges.
using EdgeLoop = std::vector<int>;

class ContainedFinder {
 public:
  ContainedFinder(const Solid& solid, const Subdivisions& subdivisions,
                  const Tolerances& tolerances, Work& work)
      : solid_(solid),
        subdivisions_(subdivisions),
        tolerances_(tolerances),
        work_(work),
        mark_(subdivisions.polygons.size(), 0) {}

  std::vector<ContainedPolygons> run() {
    for (subdivision_ = 0; subdivision_ < std::ssize(subdivisions_.subdivisions); ++subdivision_) {
      if (work_.is_used_up()) break;
      const Subdivision& subdivision = subdivisions_.subdivisions[at(subdivision_)];
      normal_ = solid_.planes[solid_.facets[subdivision.facet.index()].plane.index()].normal;
      for (int p = subdivision.first_polygon; p < subdivision.past_polygon; ++p) look_into({p});
      if (subdivision.has_hints) look_into_hints(subdivision);
      if (!subdivision.has_host) look_for_rectangles(subdivision);
    }
    const auto key = [](const ContainedPolygons& i) {
      return std::tuple(i.subdivision, -i.area_m2, i.polygons);
    };
    std::ranges::sort(out_, {}, key);
    // A host of several polygons may show again what one of them has shown.
    std::set<std::vector<int>> seen;
    std::erase_if(out_, [&](const ContainedPolygons& contained) {
      return !seen.insert(contained.polygons).second;
    });
    return std::move(out_);
  }

 private:
  /// Connected polygons of one hint may be a host.
  void look_into_hints(const Subdivision& subdivision) {
    std::vector<char> is_done(at(subdivision.past_polygon - subdivision.first_polygon), 0);
    for (int p = subdivision.first_polygon; p < subdivision.past_polygon; ++p) {
      if (is_done[at(p - subdivision.first_polygon)]) continue;
      const int hint = subdivisions_.polygons[at(p)].hint;
      std::vector<int> host =
          flood({p}, [&](int other) { return subdivisions_.polygons[at(other)].hint == hint; });
      for (const int member : host) is_done[at(member - subdivision.first_polygon)] = 1;
      if (host.size() > 1) look_into(host);
    }
  }

  /// Where there are only pieces of polygons.
  void look_for_rectangles(const Subdivision& subdivision) {
    for (InsetRectangle& inset :
         find_inset_rectangles(subdivisions_, subdivision, normal_, tolerances_, work_))
      for (const EdgeLoop& loop : loops_of(inset.polygons)) {
        Outline outline = outline_of(loop);
        if (signed_area(outline, normal_) <= 0) continue;
        add({inset.host}, std::move(inset.polygons), std::move(outline), {});
        break;
      }
  }

  [[nodiscard]] const SubdivisionEdge& edge(int e) const { return subdivisions_.edges[at(e)]; }
  /// The polygon on the other side of an edge, in the subdivision; or -1.
  [[nodiscard]] int across(int e) const {
    return edge(e).twin < 0 ? -1 : edge(edge(e).twin).polygon;
  }
  template <class Visit>
  void for_each_edge(const std::vector<int>& polygons, Visit visit) const {
    for (const int p : polygons)
      for (int e = subdivisions_.polygons[at(p)].first_edge;
           e < subdivisions_.polygons[at(p)].past_edge; ++e)
        visit(e);
  }

  /// All polygons that hang together with `seeds` over edges, `seeds` included, of those that
  /// `may_enter` lets in. Ascending.
  template <class MayEnter>
  std::vector<int> flood(std::vector<int> seeds, MayEnter may_enter) {
    const int mark = ++last_mark_;
    std::vector<int> found;
    for (const int seed : seeds)
      if (std::exchange(mark_[at(seed)], mark) != mark) found.push_back(seed);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const SubdivisionPolygon& polygon = subdivisions_.polygons[at(found[i])];
      work_.add(polygon.past_edge - polygon.first_edge);
      for (int e = polygon.first_edge; e < polygon.past_edge; ++e) {
        const int other = across(e);
        if (other < 0 || mark_[at(other)] == mark || !may_enter(other)) continue;
        mark_[at(other)] = mark;
        found.push_back(other);
      }
    }
    std::ranges::sort(found);
    return found;
  }

  /// The outlines of polygons taken together; `polygons` is ascending.
  [[nodiscard]] std::vector<EdgeLoop> loops_of(const std::vector<int>& polygons) const {
    const auto is_in = [&](int p) { return p >= 0 && std::ranges::binary_search(polygons, p); };
    std::vector<EdgeLoop> loops;
    std::set<int> seen;
    for_each_edge(polygons, [&](int start) {
      if (is_in(across(start)) || seen.contains(start)) return;
      loops.emplace_back();
      int e = start;
      do {
        work_.add(1);
        seen.insert(e);
        loops.back().push_back(e);
        e = edge(e).next;
        while (is_in(across(e))) e = edge(edge(e).twin).next;
      } while (e != start && !seen.contains(e));
    });
    return loops;
  }

  [[nodiscard]] Outline outline_of(const EdgeLoop& loop) const {
    Outline outline;
    for (const int e : loop) outline.push_back(subdivisions_.points[at(edge(e).from)]);
    return outline;
  }

  void look_into(const std::vector<int>& host) {
    if (work_.is_used_up() || (host.size() == 1 && !may_host(host[0]))) return;
    for (const EdgeLoop& loop : loops_of(host)) {
      if (signed_area(outline_of(loop), normal_) < 0)
        look_into_ring(host, loop);
      else
        look_along_outline(host, loop);
    }
  }

  /// As `may_host` of subdivisions.cpp, on the welded polygon.
  [[nodiscard]] bool may_host(int polygon) const {
    int right = 0;
    for_each_edge({polygon},
                  [&](int e) { right += turn_deg(e, edge(e).next) < -kStraight_deg ? 1 : 0; });
    return right >= 2;
  }

  /// An inner ring of the host with polygons of the subdivision behind it: behind all of it, behind
  /// three sides (a door over the slab of its balcony), or between recesses that fill the rest.
  void look_into_ring(const std::vector<int>& host, const EdgeLoop& ring) {
    std::vector<int> seeds;
    for (const int e : ring)
      if (across(e) >= 0) seeds.push_back(across(e));
    if (seeds.empty()) return;
    Outline outline = outline_of(ring);
    std::ranges::reverse(outline);
    if (seeds.size() == ring.size())
      add(host, inside(host, seeds), std::move(outline), {});
    else if (!look_along_outline(host, ring))
      add(host, inside(host, seeds), {}, std::move(outline));
  }

  std::vector<int> inside(const std::vector<int>& host, const std::vector<int>& seeds) {
    return flood(seeds, [&](int p) { return !std::ranges::binary_search(host, p); });
  }

  /// How far the way turns to the left from one edge to the next.
  [[nodiscard]] double turn_deg(int e, int f) const {
    const Vec3 p = subdivisions_.vector(e), q = subdivisions_.vector(f);
    return std::atan2(dot(cross(p, q), normal_), dot(p, q)) * 180 / std::numbers::pi;
  }

  /// Chains of the host's outline that turn inward, with polygons of the subdivision behind all of
  /// them; true if something is inset in one.
  bool look_along_outline(const std::vector<int>& host, const EdgeLoop& loop) {
    const std::size_t size = loop.size();
    const auto goes_on = [&](std::size_t i) {  // from edge i to the one after it
      const int e = loop[i % size], f = loop[(i + 1) % size];
      return across(e) >= 0 && across(f) >= 0 && turn_deg(e, f) <= kStraight_deg;
    };
    std::size_t start = 0;
    while (start < size && goes_on(start)) ++start;
    if (start == size) return false;  // an outer outline turns left somewhere
    bool has_found = false;
    for (std::size_t i = start + 1; i <= start + size && !work_.is_used_up();) {
      EdgeLoop chain{loop[i % size]};
      double turn = 0;
      for (; goes_on(i); ++i) {
        turn -= turn_deg(loop[i % size], loop[(i + 1) % size]);
        chain.push_back(loop[(i + 1) % size]);
      }
      ++i;
      if (chain.size() >= 3 && turn >= kTurn_deg) has_found |= look_behind(host, chain);
    }
    return has_found;
  }

  /// What hangs together behind the chain, if the host meets it along the chain only; else the
  /// polygons right behind the chain, under the same condition (a door beside a plinth that is in
  /// plane with it, too).
  bool look_behind(const std::vector<int>& host, const EdgeLoop& chain) {
    std::vector<int> seeds;
    for (const int e : chain) seeds.push_back(across(e));
    std::vector<int> found = inside(host, seeds);
    if (!meets_only(found, host, chain)) {
      std::ranges::sort(seeds);
      seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
      found = std::move(seeds);
      if (!meets_only(found, host, chain)) return false;
    }
    for (const EdgeLoop& loop : loops_of(found)) {
      if (std::ranges::find(loop, edge(chain[0]).twin) == loop.end()) continue;
      return add(host, std::move(found), outline_of(loop), closed(chain));
    }
    return false;
  }

  /// The chain and the straight line between its ends, seen from what it encloses.
  [[nodiscard]] Outline closed(const EdgeLoop& chain) const {
    Outline outline = outline_of(chain);
    outline.push_back(subdivisions_.points[at(subdivisions_.to(chain.back()))]);
    std::ranges::reverse(outline);
    return outline;
  }

  [[nodiscard]] bool meets_only(const std::vector<int>& polygons, const std::vector<int>& host,
                                const EdgeLoop& chain) const {
    std::size_t met = 0;
    for_each_edge(polygons, [&](int e) {
      met += across(e) >= 0 && std::ranges::binary_search(host, across(e)) ? 1 : 0;
    });
    return met == chain.size();
  }

  bool add(const std::vector<int>& host, std::vector<int> polygons, Outline outline,
           Outline whole) {
    const double area = outline.empty() ? 0 : signed_area(outline, normal_);
    const double whole_area = whole.empty() ? 0 : signed_area(whole, normal_);
    constexpr double kMore = 1.01;  // less than a hundredth more is a bent sill
    if (whole_area <= kMore * area) whole.clear();
    const Outline& larger = whole.empty() ? outline : whole;
    const double larger_area = whole.empty() ? area : whole_area;
    if (larger_area <= tolerances_.weld_m * perimeter(larger) / 2) return false;
    out_.push_back({subdivision_, host[0], std::move(polygons), std::move(outline),
                    area > 0 ? area : whole_area, std::move(whole)});
    return true;
  }

  const Solid& solid_;
  const Subdivisions& subdivisions_;
  const Tolerances& tolerances_;
  Work& work_;
  int subdivision_ = 0;
  Vec3 normal_;
  std::vector<int> mark_;  ///< by polygon, the number of the flood that reached it last
  int last_mark_ = 0;
  std::vector<ContainedPolygons> out_;
};

}  // namespace

std::vector<ContainedPolygons> find_contained(const Solid& solid, const Subdivisions& subdivisions,
                                              const Tolerances& tolerances, Work& work) {
  return ContainedFinder(solid, subdivisions, tolerances, work).run();
}

}  // namespace oriel::detail
