#include "kernel/solidify/open_shell.h"

#include "kernel/base/index.h"
#include "kernel/solidify/mend/t_vertices.h"
#include "kernel/solidify/planes/plane_clusters.h"
#include "kernel/solidify/shells/shell_mesh.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

/// Between polygons that go on in one plane: 1° is what surveyed walls show between neighbours.
constexpr double kCosineOfGoingOn = 0.99985;
/// A patch looks away from the middle clearly if the mean cosine between its normals and the
/// directions from there is at least this: of a closed box it is above 0.5.
constexpr double kClearly = 0.3;

/// The two points of an edge, the smaller first.
using DrawnEdge = std::pair<int, int>;

class OpenMeshBuilder {
 public:
  OpenMeshBuilder(Soup& soup, std::span<const DrawnEdge> drawn) : soup_(soup), drawn_(drawn) {}

  ShellMesh run() {
    link_rings();
    measure();
    group_edges();
    orient();
    pair();
    tell_vertices();
    return std::move(mesh_);
  }

 private:
  /// A half-edge with the ends of its edge.
  struct HalfEdgeEnds {
    int low, high, half_edge;
    [[nodiscard]] DrawnEdge ends() const { return {low, high}; }
  };
  /// A neighbour over an edge of two; whether the two rings run against each other there.
  struct Neighbour {
    int polygon;
    bool agrees;
  };

  [[nodiscard]] int from(int h) const { return soup_.corners[at(h)]; }
  [[nodiscard]] int to(int h) const { return soup_.corners[at(mesh_.next[at(h)])]; }
  [[nodiscard]] int polygon_of(int h) const { return mesh_.polygon_of[at(h)]; }

  void link_rings() {
    mesh_.next.resize(soup_.corners.size());
    mesh_.polygon_of.resize(soup_.corners.size());
    for (int p = 0; p < soup_.polygon_count(); ++p)
      for (const int r : soup_.rings_of(p)) {
        const int begin = soup_.first_corner[at(r)], end = soup_.first_corner[at(r) + 1];
        for (int h = begin; h < end; ++h) {
          mesh_.next[at(h)] = h + 1 < end ? h + 1 : begin;
          mesh_.polygon_of[at(h)] = p;
        }
      }
  }

  /// Area vectors and middles of the polygons.
  void measure() {
    Box box;
    for (const auto& p : soup_.points) box.grow(exact::to_metres(p, soup_.grid_m));
    const Vec3 centre = 0.5 * (box.min + box.max);
    for (int p = 0; p < soup_.polygon_count(); ++p) {
      Vec3 area, sum;
      const auto corners = soup_.corners_of(p);
      for (const int r : soup_.rings_of(p)) {
        const auto ring = soup_.ring(r);
        const Vec3 base = point(ring[0]);
        for (std::size_t i = 1; i + 1 < ring.size(); ++i)
          area = area + 0.5 * cross(point(ring[i]) - base, point(ring[i + 1]) - base);
      }
      for (const int v : corners) sum = sum + point(v);
      area_.push_back(area);
      outward_.push_back((1.0 / static_cast<double>(corners.size())) * sum - centre);
    }
  }
  [[nodiscard]] Vec3 point(int v) const {
    return exact::to_metres(soup_.points[at(v)], soup_.grid_m);
  }

  void group_edges() {
    for (int h = 0; h < soup_.corner_count(); ++h)
      edges_.push_back({std::min(from(h), to(h)), std::max(from(h), to(h)), h});
    std::ranges::sort(edges_, {},
                      [](const HalfEdgeEnds& e) { return std::tuple(e.low, e.high, e.half_edge); });
  }
  /// Whether the edge was drawn like that by some polygon, and is not what others left of it.
  [[nodiscard]] bool is_drawn(const HalfEdgeEnds& edge) const {
    return std::ranges::binary_search(drawn_, edge.ends());
  }
  /// The cosine between the normals of two polygons.
  [[nodiscard]] double flatness(int p, int q) const {
    return dot(normalised(area_[at(p)]), normalised(area_[at(q)]));
  }

  /// Visits the half-edges of each edge, as [first, past) of `edges_`.
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for (std::size_t first = 0, past = 0; first < edges_.size(); first = past) {
      while (past < edges_.size() && edges_[past].ends() == edges_[first].ends()) ++past;
      visit(first, past);
    }
  }

  void orient() {
    std::vector<std::vector<Neighbour>> neighbours(soup_.polygons.size());
    for_each_edge([&](std::size_t first, std::size_t past) {
      if (past - first != 2) return;
      const int h = edges_[first].half_edge, g = edges_[first + 1].half_edge;
      const int p = polygon_of(h), q = polygon_of(g);
      if (!is_drawn(edges_[first]) && std::abs(flatness(p, q)) < kCosineOfGoingOn) return;
      const bool agrees = from(h) != from(g);
      neighbours[at(p)].push_back({q, agrees});
      neighbours[at(q)].push_back({p, agrees});
    });
    is_turned_.assign(soup_.polygons.size(), 0);
    std::vector<char> is_seen(soup_.polygons.size(), 0);
    for (int start = 0; start < soup_.polygon_count(); ++start) {
      if (is_seen[at(start)]) continue;
      is_seen[at(start)] = 1;
      std::vector<int> patch{start};
      for (std::size_t i = 0; i < patch.size(); ++i)
        for (const Neighbour& n : neighbours[at(patch[i])]) {
          if (std::exchange(is_seen[at(n.polygon)], 1)) continue;
          is_turned_[at(n.polygon)] =
              static_cast<char>(n.agrees ? is_turned_[at(patch[i])] : !is_turned_[at(patch[i])]);
          patch.push_back(n.polygon);
        }
      if (looks_inward(patch))
        for (const int p : patch) is_turned_[at(p)] = static_cast<char>(!is_turned_[at(p)]);
    }
    for (int p = 0; p < soup_.polygon_count(); ++p)
      if (is_turned_[at(p)]) turn_round(p);
  }

  [[nodiscard]] bool looks_inward(std::span<const int> patch) const {
    double away = 0, all = 0, as_it_was = 0;
    for (const int p : patch) {
      const double sign = is_turned_[at(p)] ? -1 : 1;
      away += sign * dot(area_[at(p)], outward_[at(p)]);
      all += length(area_[at(p)]) * length(outward_[at(p)]);
      as_it_was += sign * length(area_[at(p)]);
    }
    return std::abs(away) >= kClearly * all ? away < 0 : as_it_was < 0;
  }

  /// Rings keep their first corners.
  void turn_round(int polygon) {
    for (const int r : soup_.rings_of(polygon)) {
      const auto ring = soup_.ring(r);
      std::reverse(ring.begin() + 1, ring.end());
    }
    area_[at(polygon)] = -area_[at(polygon)];
  }

  void pair() {
    edges_.clear();  // half-edges have other ends now
    group_edges();
    mesh_.twin.assign(soup_.corners.size(), -1);
    for_each_edge([&](std::size_t first, std::size_t past) {
      const bool is_usual = past - first == 2 && is_drawn(edges_[first]);
      std::vector<std::tuple<double, int, int>> pairs;  // the flattest first
      for (std::size_t i = first; i < past; ++i)
        for (std::size_t j = first; j < past; ++j) {
          const int h = edges_[i].half_edge, g = edges_[j].half_edge;
          if (from(h) != edges_[i].low || from(g) == edges_[j].low) continue;
          const double flat = flatness(polygon_of(h), polygon_of(g));
          if (is_usual || flat >= kCosineOfGoingOn) pairs.emplace_back(-flat, h, g);
        }
      std::ranges::sort(pairs);
      for (const auto& [flat, h, g] : pairs) {
        if (mesh_.twin[at(h)] >= 0 || mesh_.twin[at(g)] >= 0) continue;
        mesh_.twin[at(h)] = g;
        mesh_.twin[at(g)] = h;
      }
    });
  }

  void tell_vertices() {
    mesh_.vertex_of.assign(soup_.corners.begin(), soup_.corners.end());
    mesh_.point_of.resize(soup_.points.size());
    for (int v = 0; v < std::ssize(soup_.points); ++v) mesh_.point_of[at(v)] = v;
  }

  Soup& soup_;
  std::span<const DrawnEdge> drawn_;
  ShellMesh mesh_;
  std::vector<HalfEdgeEnds> edges_;  ///< sorted
  std::vector<Vec3> area_, outward_;
  std::vector<char> is_turned_;
};

/// The edges of all polygons, sorted.
std::vector<DrawnEdge> edges_of(const Soup& soup) {
  std::vector<DrawnEdge> edges;
  for (int r = 0; r < soup.ring_count(); ++r) {
    const auto ring = soup.ring(r);
    for (std::size_t i = 0; i < ring.size(); ++i)
      edges.push_back(std::minmax({ring[i], ring[(i + 1) % ring.size()]}));
  }
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges);
  edges.erase(repeated.begin(), repeated.end());
  return edges;
}

bool is_mostly_triangles(const Soup& soup) {
  int triangles = 0;
  for (int p = 0; p < soup.polygon_count(); ++p)
    triangles += soup.corners_of(p).size() == 3 ? 1 : 0;
  return 2 * triangles > soup.polygon_count();
}

/// Triangles without area go, and points are put into the open edges that they lie on: so it does
/// not matter whether a triangulator makes such triangles or lets several meet a longer edge.
Soup joined_triangles(const Soup& soup, double reach) {
  const std::vector<PolygonShape> shapes = shapes_of(soup);
  SoupBuilder builder(soup);
  for (int p = 0; p < soup.polygon_count(); ++p)
    if (shapes[at(p)].normal) builder.add_polygon(soup, p);
  return insert_t_vertices(builder.finish(), reach).soup;
}

/// The half-edges of polygons that need not close: never fails, and leaves open (twin -1) what does
/// not pair up. Every point is one vertex.
///
/// Polygons are turned round until neighbours agree; where they cannot, those between them stay
/// open. Each connected patch then looks away from the middle of the building if most of it does
/// so clearly, else as most of its polygons did. Where more than two polygons meet at an edge,
/// those that go on in one plane are paired. Over what was left of an edge of triangles when points
/// were put into it, only those that go on in one plane are neighbours. The soup's rings are turned
/// round along.
ShellMesh build_open_mesh(Soup& soup, const Tolerances& tolerances) {
  const std::vector<DrawnEdge> drawn = edges_of(soup);
  if (is_mostly_triangles(soup)) soup = joined_triangles(soup, tolerances.weld_m / soup.grid_m);
  return OpenMeshBuilder(soup, drawn).run();
}

}  // namespace

}  // namespace oriel::detail

namespace oriel {

namespace {

using detail::ShellMesh;

bool has_room(const Building& building, const Tolerances& tolerances) {
  const double limit = static_cast<double>(exact::kMaxCoordinate) * grid_for(tolerances.weld_m);
  return std::ranges::all_of(building.vertices, [&](Vec3 p) {
    return std::abs(p.x) <= limit && std::abs(p.y) <= limit && std::abs(p.z) <= limit;
  });
}

class FacetMaker {
 public:
  FacetMaker(const Soup& soup, const ShellMesh& mesh, const detail::PlaneClusters& clusters)
      : soup_(soup),
        mesh_(mesh),
        clusters_(clusters),
        facet_of_(soup.polygons.size(), -1),
        half_edges_of_(soup.polygons.size()) {}

  Solid run() {
    out_.grid_m = soup_.grid_m;
    out_.planes = clusters_.planes;
    for (const auto& p : soup_.points)
      out_.vertices.push_back({exact::to_metres(p, soup_.grid_m), false});
    for (int h = 0; h < std::ssize(mesh_.next); ++h)
      half_edges_of_[at(mesh_.polygon_of[at(h)])].push_back(h);
    is_walked_.assign(mesh_.next.size(), 0);
    for (int p = 0; p < soup_.polygon_count(); ++p)
      if (facet_of_[at(p)] < 0) grow(p);
    return std::move(out_);
  }

 private:
  /// The facet of all polygons that hang together with this one in its plane.
  void grow(int seed) {
    const int number = next_number_++;
    Facet facet{PlaneId{clusters_.plane_of[at(seed)]}, {}, {}};
    std::vector<int> members{seed};
    facet_of_[at(seed)] = number;
    for (std::size_t i = 0; i < members.size(); ++i)
      for (const int h : half_edges_of_[at(members[i])]) {
        const int twin = mesh_.twin[at(h)];
        if (twin < 0) continue;
        const int other = mesh_.polygon_of[at(twin)];
        if (facet_of_[at(other)] >= 0 ||
            clusters_.plane_of[at(other)] != clusters_.plane_of[at(seed)])
          continue;
        facet_of_[at(other)] = number;
        members.push_back(other);
      }
    for (const int p : members) facet.polygons.push_back(soup_.polygons[at(p)].source);
    std::ranges::sort(facet.polygons);
    std::ranges::sort(members);
    for (const int p : members)
      for (const int h : half_edges_of_[at(p)])
        if (!is_walked_[at(h)] && !is_inside(h)) facet.loops.push_back(walk(h));
    if (facet.loops.empty()) return;  // welding has folded it onto itself
    put_outer_first(facet);
    out_.facets.push_back(std::move(facet));
  }

  /// Both sides of the edge are in one facet.
  [[nodiscard]] bool is_inside(int h) const {
    const int twin = mesh_.twin[at(h)];
    return twin >= 0 &&
           facet_of_[at(mesh_.polygon_of[at(h)])] == facet_of_[at(mesh_.polygon_of[at(twin)])];
  }

  Loop walk(int start) {
    Loop loop;
    for (int h = start; !is_walked_[at(h)];) {
      is_walked_[at(h)] = 1;
      loop.push_back(soup_.corners[at(h)]);
      h = mesh_.next[at(h)];
      while (is_inside(h)) h = mesh_.next[at(mesh_.twin[at(h)])];
    }
    return loop;
  }

  void put_outer_first(Facet& facet) const {
    const Vec3 normal = out_.planes[facet.plane.index()].normal;
    const auto outer = std::ranges::max_element(facet.loops, {}, [&](const Loop& loop) {
      return signed_area_m2(out_.vertices, loop, normal);
    });
    std::iter_swap(facet.loops.begin(), outer);
  }

  const Soup& soup_;
  const ShellMesh& mesh_;
  const detail::PlaneClusters& clusters_;
  std::vector<int> facet_of_;
  std::vector<std::vector<int>> half_edges_of_;
  std::vector<char> is_walked_;
  int next_number_ = 0;  ///< of a facet in facet_of_
  Solid out_;
};

}  // namespace

std::optional<Solid> open_shell(const Building& building, const Tolerances& tolerances) {
  if (!has_room(building, tolerances)) return std::nullopt;
  std::vector<Issue> of_solidify;  // solidify has reported them
  Soup soup = weld(building, tolerances, of_solidify);
  if (soup.polygons.empty()) return std::nullopt;
  const ShellMesh mesh = detail::build_open_mesh(soup, tolerances);
  Work work(kWorkBudget);
  const detail::PlaneClusters clusters = detail::cluster_planes(soup, mesh, tolerances, work);
  Solid shell = FacetMaker(soup, mesh, clusters).run();
  if (shell.facets.empty()) return std::nullopt;
  return shell;
}

}  // namespace oriel
