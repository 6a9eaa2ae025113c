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
using EdgeLoop = std::vector<InputEdgeId>;
/// Polygons, ascending.
using InputPolygons = std::vector<InputPolygonId>;

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
    for (const SubdivisionId s : subdivisions_.subdivisions.ids()) {
      if (work_.is_used_up()) break;
      subdivision_ = s;
      const Subdivision& subdivision = subdivisions_.subdivisions[s];
      normal_ = solid_.planes[solid_.facets[subdivision.facet.index()].plane.index()].normal;
      for (const InputPolygonId p : subdivision.polygons()) look_into({p});
      if (subdivision.has_hints) look_into_hints(subdivision);
      if (!subdivision.has_host) look_for_rectangles(subdivision);
    }
    const auto key = [](const ContainedPolygons& i) {
      return std::tuple(i.subdivision, -i.area_m2, i.polygons);
    };
    std::ranges::sort(out_, {}, key);
    // A host of several polygons may show again what one of them has shown.
    std::set<InputPolygons> seen;
    std::erase_if(out_, [&](const ContainedPolygons& contained) {
      return !seen.insert(contained.polygons).second;
    });
    return std::move(out_);
  }

 private:
  /// Connected polygons of one hint may be a host.
  void look_into_hints(const Subdivision& subdivision) {
    std::set<InputPolygonId> done;
    for (const InputPolygonId p : subdivision.polygons()) {
      if (done.contains(p)) continue;
      const int hint = subdivisions_.polygons[p].hint;
      InputPolygons host = flood(
          {p}, [&](InputPolygonId other) { return subdivisions_.polygons[other].hint == hint; });
      done.insert(host.begin(), host.end());
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

  [[nodiscard]] const SubdivisionEdge& edge(InputEdgeId e) const { return subdivisions_.edges[e]; }
  /// The polygon on the other side of an edge, in the subdivision, if any.
  [[nodiscard]] InputPolygonId across(InputEdgeId e) const {
    return edge(e).twin.is_valid() ? edge(edge(e).twin).polygon : InputPolygonId{};
  }
  template <class Visit>
  void for_each_edge(const InputPolygons& polygons, Visit visit) const {
    for (const InputPolygonId p : polygons)
      for (const InputEdgeId e : subdivisions_.polygons[p].edges()) visit(e);
  }

  /// All polygons that hang together with `seeds` over edges, `seeds` included, of those that
  /// `may_enter` lets in. Ascending.
  template <class MayEnter>
  InputPolygons flood(InputPolygons seeds, MayEnter may_enter) {
    const int mark = ++last_mark_;
    InputPolygons found;
    for (const InputPolygonId seed : seeds)
      if (std::exchange(mark_[seed], mark) != mark) found.push_back(seed);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const SubdivisionPolygon& polygon = subdivisions_.polygons[found[i]];
      work_.add(std::ssize(polygon.edges()));
      for (const InputEdgeId e : polygon.edges()) {
        const InputPolygonId other = across(e);
        if (!other.is_valid() || mark_[other] == mark || !may_enter(other)) continue;
        mark_[other] = mark;
        found.push_back(other);
      }
    }
    std::ranges::sort(found);
    return found;
  }

  /// The outlines of polygons taken together; `polygons` is ascending.
  [[nodiscard]] std::vector<EdgeLoop> loops_of(const InputPolygons& polygons) const {
    const auto is_in = [&](InputPolygonId p) {
      return p.is_valid() && std::ranges::binary_search(polygons, p);
    };
    std::vector<EdgeLoop> loops;
    std::set<InputEdgeId> seen;
    for_each_edge(polygons, [&](InputEdgeId start) {
      if (is_in(across(start)) || seen.contains(start)) return;
      loops.emplace_back();
      InputEdgeId e = start;
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
    for (const InputEdgeId e : loop) outline.push_back(subdivisions_.start(e));
    return outline;
  }

  void look_into(const InputPolygons& host) {
    if (work_.is_used_up() || (host.size() == 1 && !may_host(host[0]))) return;
    for (const EdgeLoop& loop : loops_of(host)) {
      if (signed_area(outline_of(loop), normal_) < 0)
        look_into_ring(host, loop);
      else
        look_along_outline(host, loop);
    }
  }

  /// As `may_host` of subdivisions.cpp, on the welded polygon.
  [[nodiscard]] bool may_host(InputPolygonId polygon) const {
    int right = 0;
    for_each_edge({polygon}, [&](InputEdgeId e) {
      right += turn_deg(e, edge(e).next) < -kStraight_deg ? 1 : 0;
    });
    return right >= 2;
  }

  /// An inner ring of the host with polygons of the subdivision behind it: behind all of it, behind
  /// three sides (a door over the slab of its balcony), or between recesses that fill the rest.
  void look_into_ring(const InputPolygons& host, const EdgeLoop& ring) {
    InputPolygons seeds;
    for (const InputEdgeId e : ring)
      if (across(e).is_valid()) seeds.push_back(across(e));
    if (seeds.empty()) return;
    Outline outline = outline_of(ring);
    std::ranges::reverse(outline);
    if (seeds.size() == ring.size())
      add(host, inside(host, seeds), std::move(outline), {});
    else if (!look_along_outline(host, ring))
      add(host, inside(host, seeds), {}, std::move(outline));
  }

  InputPolygons inside(const InputPolygons& host, const InputPolygons& seeds) {
    return flood(seeds, [&](InputPolygonId p) { return !std::ranges::binary_search(host, p); });
  }

  /// How far the way turns to the left from one edge to the next.
  [[nodiscard]] double turn_deg(InputEdgeId e, InputEdgeId f) const {
    const Vec3 p = subdivisions_.vector(e), q = subdivisions_.vector(f);
    return std::atan2(dot(cross(p, q), normal_), dot(p, q)) * 180 / std::numbers::pi;
  }

  /// Chains of the host's outline that turn inward, with polygons of the subdivision behind all of
  /// them; true if something is inset in one.
  bool look_along_outline(const InputPolygons& host, const EdgeLoop& loop) {
    const std::size_t size = loop.size();
    const auto goes_on = [&](std::size_t i) {  // from edge i to the one after it
      const InputEdgeId e = loop[i % size], f = loop[(i + 1) % size];
      return across(e).is_valid() && across(f).is_valid() && turn_deg(e, f) <= kStraight_deg;
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
  bool look_behind(const InputPolygons& host, const EdgeLoop& chain) {
    InputPolygons seeds;
    for (const InputEdgeId e : chain) seeds.push_back(across(e));
    InputPolygons found = inside(host, seeds);
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
    outline.push_back(subdivisions_.start(edge(chain.back()).next));
    std::ranges::reverse(outline);
    return outline;
  }

  [[nodiscard]] bool meets_only(const InputPolygons& polygons, const InputPolygons& host,
                                const EdgeLoop& chain) const {
    std::size_t met = 0;
    for_each_edge(polygons, [&](InputEdgeId e) {
      met += across(e).is_valid() && std::ranges::binary_search(host, across(e)) ? 1 : 0;
    });
    return met == chain.size();
  }

  bool add(const InputPolygons& host, InputPolygons polygons, Outline outline, Outline whole) {
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
  SubdivisionId subdivision_;
  Vec3 normal_;
  IndexedVector<InputPolygonId, int> mark_;  ///< the number of the flood that reached it last
  int last_mark_ = 0;
  std::vector<ContainedPolygons> out_;
};

}  // namespace

std::vector<ContainedPolygons> find_contained(const Solid& solid, const Subdivisions& subdivisions,
                                              const Tolerances& tolerances, Work& work) {
  return ContainedFinder(solid, subdivisions, tolerances, work).run();
}

}  // namespace oriel::detail
