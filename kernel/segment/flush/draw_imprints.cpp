#include "kernel/segment/flush/draw_imprints.h"

#include "kernel/base/index.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "model/solid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

/// Splits facets of a solid along closed outlines in their planes, and keeps the solid closed.
class FacetSplitter {
 public:
  /// Corners nearer than `snap_m` to a vertex or an edge of the facet are put there.
  FacetSplitter(Solid solid, double snap_m);

  /// Splits a facet: the part inside the outline (counter-clockwise seen from outside) becomes a
  /// facet with the polygons of `inside`, what is left keeps the others. False if the outline
  /// leaves the facet, crosses itself, or runs the other way.
  bool split(FacetId facet, const Outline& outline, const std::vector<int>& inside);

  [[nodiscard]] const Solid& solid() const { return solid_; }
  [[nodiscard]] Solid take() { return std::move(solid_); }

 private:
  using DirectedEdge = std::pair<int, int>;

  [[nodiscard]] Vec3 point(int v) const {
    return solid_.vertices[static_cast<std::size_t>(v)].point;
  }
  Facet& facet(int f) { return solid_.facets[static_cast<std::size_t>(f)]; }
  [[nodiscard]] Outline outline_of(const Loop& loop) const;
  void enter_all_edges();
  void enter_edges(int f);
  void put(int place, int sibling, Facet made);
  std::optional<std::vector<Loop>> loops_left(int f, const Loop& ring, Vec3 normal,
                                              std::vector<Loop>& within);
  [[nodiscard]] std::optional<std::vector<std::vector<Loop>>> parts_of(
      const std::vector<Loop>& loops, Vec3 normal) const;
  int add_vertex(Vec3 p);
  std::optional<Loop> fitted(int f, const Outline& outline);
  std::optional<int> corner_at(int f, Vec3 p);
  void insert_on_edge(DirectedEdge edge, int vertex);
  void insert_into(int f, DirectedEdge edge, int vertex);
  [[nodiscard]] Loop with_vertices_between(const Loop& ring, int f) const;
  [[nodiscard]] bool crosses(int f, const Loop& ring, Vec3 normal) const;
  [[nodiscard]] bool is_hole_in(const Loop& loop, const Loop& ring, Vec3 normal) const;
  [[nodiscard]] std::optional<std::vector<Loop>> trace(const std::vector<DirectedEdge>& edges,
                                                       Vec3 normal) const;

  Solid solid_;
  double snap_m_;
  std::vector<int> shell_of_;
  std::map<DirectedEdge, int> facet_of_;  ///< by directed edge; empty until one is divided
  std::map<std::tuple<double, double, double>, int> made_;
};

int after(const Loop& loop, std::size_t i) { return loop[(i + 1) % loop.size()]; }

/// A loop that comes to a vertex again, as loops that come to none twice: they touch there.
void add_simple_loops(const Loop& loop, std::vector<Loop>& loops) {
  Loop way;
  for (const int v : loop) {
    const auto first = std::ranges::find(way, v);
    if (first != way.end()) {
      loops.emplace_back(first, way.end());
      way.erase(first, way.end());
    }
    way.push_back(v);
  }
  loops.push_back(std::move(way));
}

FacetSplitter::FacetSplitter(Solid solid, double snap_m)
    : solid_(std::move(solid)), snap_m_(snap_m), shell_of_(solid_.facets.size(), -1) {
  for (int s = 0; s < std::ssize(solid_.shells); ++s)
    for (const FacetId f : solid_.shells[at(s)].facets) shell_of_[f.index()] = s;
}

/// Once an edge is divided, which few outlines do, edges are entered as they change.
void FacetSplitter::enter_all_edges() {
  if (!facet_of_.empty()) return;
  for (int f = 0; f < std::ssize(solid_.facets); ++f) enter_edges(f);
}

void FacetSplitter::enter_edges(int f) {
  for (const Loop& loop : facet(f).loops)
    for (std::size_t i = 0; i < loop.size(); ++i) facet_of_[{loop[i], after(loop, i)}] = f;
}

Outline FacetSplitter::outline_of(const Loop& loop) const {
  Outline outline;
  for (const int v : loop) outline.push_back(point(v));
  return outline;
}

bool FacetSplitter::split(FacetId id, const Outline& outline, const std::vector<int>& inside) {
  const int f = id.value;
  const Vec3 normal = solid_.planes[facet(f).plane.index()].normal;
  const auto ring = fitted(f, outline);
  if (!ring || signed_area(outline_of(*ring), normal) <= 0 || crosses(f, *ring, normal))
    return false;
  std::vector<Loop> within{*ring};
  const auto left = loops_left(f, *ring, normal, within);
  if (!left) return false;
  auto parts = parts_of(*left, normal);
  if (!parts) return false;

  const Facet old = facet(f);
  std::vector<int> own, others;
  std::ranges::set_intersection(old.polygons, inside, std::back_inserter(own));
  std::ranges::set_difference(old.polygons, inside, std::back_inserter(others));
  int place = f;  // the first new facet takes the place of the old one
  for (std::vector<Loop>& part : *parts) {
    put(place, f, {old.plane, std::move(part), others});
    place = static_cast<int>(solid_.facets.size());
  }
  put(place, f, {old.plane, std::move(within), own.empty() ? inside : own});
  return true;
}

/// The loops of what is left of a facet without the ring; the facet's holes inside the ring go to
/// `within`. Nothing if the ring lies outside the facet somewhere.
std::optional<std::vector<Loop>> FacetSplitter::loops_left(int f, const Loop& ring, Vec3 normal,
                                                           std::vector<Loop>& within) {
  std::set<DirectedEdge> of_ring;
  for (std::size_t i = 0; i < ring.size(); ++i) of_ring.insert({ring[i], after(ring, i)});
  const std::set<int> corners(ring.begin(), ring.end());
  const Outline outline = outline_of(ring);
  std::vector<Loop> untouched;
  std::vector<DirectedEdge> edges;  // of the loops that the ring meets, to be traced anew
  for (const Loop& loop : facet(f).loops) {
    if (std::ranges::none_of(loop, [&](int v) { return corners.contains(v); })) {
      (contains({{outline}}, normal, point(loop[0])) ? within : untouched).push_back(loop);
      continue;
    }
    if (is_hole_in(loop, ring, normal)) {
      within.push_back(loop);
      continue;
    }
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const DirectedEdge edge{loop[i], after(loop, i)};
      if (of_ring.contains({edge.second, edge.first})) return std::nullopt;
      if (of_ring.erase(edge) == 0) edges.push_back(edge);
    }
  }
  for (const DirectedEdge& edge : of_ring) edges.emplace_back(edge.second, edge.first);
  auto loops = trace(edges, normal);
  if (loops) std::ranges::move(untouched, std::back_inserter(*loops));
  return loops;
}

/// True if an edge of the ring crosses another one, or one of the facet's, other than in a vertex.
bool FacetSplitter::crosses(int f, const Loop& ring, Vec3 normal) const {
  const auto meets = [&](int a, int b, const Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int c = loop[i], d = after(loop, i);
      if (a == c || a == d || b == c || b == d) continue;
      if (do_cross(point(a), point(b), point(c), point(d), normal)) return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const int from = ring[i], to = after(ring, i);
    if (meets(from, to, ring)) return true;
    for (const Loop& loop : solid_.facets[at(f)].loops)
      if (meets(from, to, loop)) return true;
  }
  return false;
}

/// True of a hole inside a ring that it meets in vertices only.
bool FacetSplitter::is_hole_in(const Loop& loop, const Loop& ring, Vec3 normal) const {
  const Outline outline = outline_of(loop);
  if (signed_area(outline, normal) >= 0) return false;
  const auto inside = interior_point({{outline}}, normal);
  return inside && contains({{outline_of(ring)}}, normal, *inside);
}

/// Outer loops, each with the holes in it. Nothing if a hole is in none.
std::optional<std::vector<std::vector<Loop>>> FacetSplitter::parts_of(
    const std::vector<Loop>& loops, Vec3 normal) const {
  std::vector<std::vector<Loop>> parts;
  for (const Loop& loop : loops)
    if (signed_area(outline_of(loop), normal) > 0) parts.push_back({loop});
  for (const Loop& loop : loops) {
    if (signed_area(outline_of(loop), normal) > 0) continue;
    // A corner of it may lie on the outer loop.
    const auto inside = interior_point({{outline_of(loop)}}, normal).value_or(point(loop[0]));
    const auto home = std::ranges::find_if(parts, [&](const std::vector<Loop>& part) {
      return parts.size() == 1 || contains({{outline_of(part[0])}}, normal, inside);
    });
    if (home == parts.end()) return std::nullopt;
    home->push_back(loop);
  }
  return parts;
}

/// Puts a facet in its place, in the shell of facet `sibling`.
void FacetSplitter::put(int place, int sibling, Facet made) {
  if (place == std::ssize(solid_.facets)) {
    solid_.facets.emplace_back();
    shell_of_.push_back(shell_of_[at(sibling)]);
    if (shell_of_[at(sibling)] >= 0)
      solid_.shells[at(shell_of_[at(sibling)])].facets.push_back(FacetId{place});
  }
  facet(place) = std::move(made);
  if (!facet_of_.empty()) enter_edges(place);
}

int FacetSplitter::add_vertex(Vec3 p) {
  const auto [entry, is_new] =
      made_.emplace(std::tuple(p.x, p.y, p.z), static_cast<int>(solid_.vertices.size()));
  if (is_new) solid_.vertices.push_back({p, false});
  return entry->second;
}

/// The outline as a loop whose corners are vertices, on the edges of the facet where they meet
/// them. Nothing if fewer than three are left, or one comes twice.
std::optional<Loop> FacetSplitter::fitted(int f, const Outline& outline) {
  Loop ring;
  for (const Vec3 p : outline) {
    const auto corner = corner_at(f, p);
    if (!corner) return std::nullopt;
    if (ring.empty() || (ring.back() != *corner && ring.front() != *corner))
      ring.push_back(*corner);
  }
  ring = with_vertices_between(ring, f);
  if (ring.size() < 3 || std::set<int>(ring.begin(), ring.end()).size() != ring.size())
    return std::nullopt;
  return ring;
}

/// The vertex for a corner: one of the facet's, one put into an edge of it, or a new one inside;
/// nothing if the corner is outside.
std::optional<int> FacetSplitter::corner_at(int f, Vec3 p) {
  std::optional<std::pair<double, int>> nearest;
  std::optional<std::pair<double, DirectedEdge>> nearest_edge;
  std::vector<Outline> outlines;
  for (const Loop& loop : facet(f).loops) {
    outlines.push_back(outline_of(loop));
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const double to_vertex = length(point(loop[i]) - p);
      if (to_vertex <= snap_m_ && (!nearest || std::pair(to_vertex, loop[i]) < *nearest))
        nearest = {to_vertex, loop[i]};
      const double to_edge = distance_to_segment(p, point(loop[i]), point(after(loop, i)));
      const DirectedEdge edge{loop[i], after(loop, i)};
      if (to_edge <= snap_m_ && (!nearest_edge || std::pair(to_edge, edge) < *nearest_edge))
        nearest_edge = {to_edge, edge};
    }
  }
  if (nearest) return nearest->second;
  if (nearest_edge) {
    const auto [from, to] = nearest_edge->second;
    const Vec3 along = point(to) - point(from);
    const double t = dot(p - point(from), along) / dot(along, along);
    const int vertex = add_vertex(point(from) + t * along);
    insert_on_edge(nearest_edge->second, vertex);
    return vertex;
  }
  if (!contains(outlines, solid_.planes[facet(f).plane.index()].normal, p)) return std::nullopt;
  return add_vertex(p);
}

void FacetSplitter::insert_on_edge(DirectedEdge edge, int vertex) {
  enter_all_edges();
  for (const DirectedEdge& side : {edge, DirectedEdge{edge.second, edge.first}})
    if (const auto found = facet_of_.find(side); found != facet_of_.end())
      insert_into(found->second, side, vertex);
}

void FacetSplitter::insert_into(int f, DirectedEdge edge, int vertex) {
  for (Loop& loop : facet(f).loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (loop[i] != edge.first || after(loop, i) != edge.second) continue;
      loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, vertex);
      facet_of_.erase(edge);
      facet_of_[{edge.first, vertex}] = f;
      facet_of_[{vertex, edge.second}] = f;
      return;
    }
}

/// Vertices of the facet that lie on an edge of the ring become corners of it.
Loop FacetSplitter::with_vertices_between(const Loop& ring, int f) const {
  Loop out;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    out.push_back(ring[i]);
    const Vec3 from = point(ring[i]), along = point(after(ring, i)) - from;
    std::vector<std::pair<double, int>> between;
    for (const Loop& loop : solid_.facets[at(f)].loops)
      for (const int v : loop) {
        if (std::ranges::find(ring, v) != ring.end()) continue;
        const double t = dot(point(v) - from, along) / dot(along, along);
        if (t > 0 && t < 1 && length(from + t * along - point(v)) <= snap_m_)
          between.emplace_back(t, v);
      }
    std::ranges::sort(between);
    for (const auto& [t, v] : between) out.push_back(v);
  }
  return out;
}

/// The loops that edges make, the surface to their left, none of which comes to a vertex twice;
/// nothing if they make none.
std::optional<std::vector<Loop>> FacetSplitter::trace(const std::vector<DirectedEdge>& edges,
                                                      Vec3 normal) const {
  std::map<int, std::vector<int>> targets;
  for (const auto& [from, to] : edges) targets[from].push_back(to);
  // Where loops meet in a vertex, the edge that comes first clockwise from the way back.
  const auto next = [&](int from, int via) -> std::optional<int> {
    const auto found = targets.find(via);
    if (found == targets.end() || found->second.empty()) return std::nullopt;
    const Vec3 back = point(from) - point(via);
    const auto clockwise = [&](int to) {
      const Vec3 out = point(to) - point(via);
      const double angle = std::atan2(dot(cross(out, back), normal), dot(out, back));
      return angle > 0 ? angle : angle + 2 * std::numbers::pi;
    };
    const auto best = std::ranges::min_element(found->second, {}, clockwise);
    const int to = *best;
    found->second.erase(best);
    return to;
  };
  std::vector<Loop> loops;
  for (const auto& [start, unused] : targets) {
    while (!targets[start].empty()) {
      Loop loop{start};
      int to = targets[start].back();
      targets[start].pop_back();
      while (to != start) {
        loop.push_back(to);
        const auto further = next(loop[loop.size() - 2], to);
        if (!further) return std::nullopt;
        to = *further;
      }
      add_simple_loops(loop, loops);
    }
  }
  if (std::ranges::any_of(loops, [](const Loop& loop) { return loop.size() < 3; }))
    return std::nullopt;
  return loops;
}

}  // namespace

}  // namespace oriel::detail

namespace oriel {

namespace {

auto key_of(const Plane& plane) { return std::pair(plane.coefficients, plane.offset); }

class ImprintDrawer {
 public:
  ImprintDrawer(Solid solid, const Segmentation& segmentation, double snap_m)
      : segmentation_(segmentation), splitter_(std::move(solid), snap_m) {
    for (int f = 0; f < std::ssize(facets()); ++f) enter(f);
  }

  Solid run(const std::vector<FeatureId>& imprints) {
    for (const FeatureId id : imprints) draw(segmentation_.features[id.index()]);
    return splitter_.take();
  }

 private:
  [[nodiscard]] const std::vector<Facet>& facets() const { return splitter_.solid().facets; }

  void enter(int f) {
    for (const int polygon : facets()[at(f)].polygons) facets_of_[polygon].push_back(FacetId{f});
  }

  void draw(const Feature& imprint) {
    Outline outline;
    for (const int v : imprint.outline) outline.push_back(segmentation_.vertices[at(v)].point);
    const Plane& plane = segmentation_.planes[imprint.planes.front().index()];
    const auto home = home_of(imprint, plane);
    if (!home) return;
    const auto before = static_cast<int>(facets().size());
    splitter_.split(*home, outline, imprint.source_polygons);
    for (int f = before; f < std::ssize(facets()); ++f) enter(f);
  }

  /// The facet of its plane around the middle of an imprint.
  [[nodiscard]] std::optional<FacetId> home_of(const Feature& imprint, const Plane& plane) const {
    std::vector<FacetId> candidates;
    for (const int polygon : imprint.source_polygons)
      if (const auto found = facets_of_.find(polygon); found != facets_of_.end())
        candidates.insert(candidates.end(), found->second.begin(), found->second.end());
    std::ranges::sort(candidates);
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    for (const FacetId f : candidates) {
      if (key_of(splitter_.solid().planes[facets()[f.index()].plane.index()]) != key_of(plane))
        continue;
      const auto outlines = outlines_of(splitter_.solid().vertices, facets()[f.index()].loops);
      // The middle may lie in the recess that a sash makes: then the outer loop decides.
      if (contains({outlines.data(), 1}, plane.normal, imprint.cap_point) &&
          has_polygon_of(imprint, facets()[f.index()]))
        return f;
    }
    return std::nullopt;
  }

  [[nodiscard]] static bool has_polygon_of(const Feature& imprint, const Facet& facet) {
    std::vector<int> common;
    std::ranges::set_intersection(imprint.source_polygons, facet.polygons,
                                  std::back_inserter(common));
    return !common.empty();
  }

  const Segmentation& segmentation_;
  detail::FacetSplitter splitter_;
  /// By Polygon::source; facets that have been split since may no longer name the polygon.
  std::unordered_map<int, std::vector<FacetId>> facets_of_;
};

}  // namespace

Solid draw_imprints(Solid solid, const Segmentation& segmentation,
                    const std::vector<FeatureId>& imprints, const Tolerances& tolerances) {
  if (imprints.empty()) return solid;
  const double snap_m = tolerances.plane_offset_m + tolerances.weld_m;
  return ImprintDrawer(std::move(solid), segmentation, snap_m).run(imprints);
}

}  // namespace oriel
