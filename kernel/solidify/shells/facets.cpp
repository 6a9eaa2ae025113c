#include "kernel/solidify/shells/facets.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "model/description/counting_sort.h"

#include <algorithm>
#include <utility>

namespace oriel::detail {

namespace {

class Drafter {
 public:
  Drafter(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& mesh,
          std::span<const char> is_apart)
      : soup_(soup), clusters_(clusters), mesh_(mesh), is_apart_(is_apart) {}

  FacetDraft run() {
    grow_facets();
    number_components();
    find_loops();
    choose_vertices();
    collect_loops();
    return std::move(draft_);
  }

 private:
  [[nodiscard]] int facet_of(int h) const { return draft_.facet_of[at(mesh_.polygon_of[at(h)])]; }

  void grow_facets() {
    draft_.facet_of.assign(soup_.polygons.size(), -1);
    draft_.plane.reserve(soup_.polygons.size());
    side_.resize(mesh_.half_edge_count());
    Numbers patch;
    for (int start = 0; start < soup_.polygon_count(); ++start) {
      if (draft_.facet_of[at(start)] >= 0) continue;
      const int facet = static_cast<int>(draft_.plane.size());
      draft_.plane.push_back(clusters_.plane_of[at(start)]);
      draft_.facet_of[at(start)] = facet;
      for (patch.assign(1, start); !patch.empty();) {
        const int p = patch.back();
        patch.pop_back();
        grow_over(p, facet, patch);
      }
    }
  }

  /// Takes the neighbours of a polygon that lie on its plane into the facet; the other half-edges
  /// are its rim.
  void grow_over(int polygon, int facet, Numbers& patch) {
    const int plane = clusters_.plane_of[at(polygon)];
    const int begin = soup_.first_corner[at(soup_.first_ring[at(polygon)])];
    const int end = soup_.first_corner[at(soup_.first_ring[at(polygon) + 1])];
    const int *const polygon_of = mesh_.polygon_of.data(), *const twin = mesh_.twin.data();
    const int* const plane_of = clusters_.plane_of.data();
    HalfEdgeState* const side = side_.data();
    const bool is_own = is_kept_apart(polygon);
    for (int h = begin; h < end; ++h) {
      const int q = polygon_of[twin[h]];
      const bool is_rim = plane_of[q] != plane || is_kept_apart(q) != is_own;
      side[h] = is_rim ? HalfEdgeState::rim : HalfEdgeState::interior;
      if (is_rim || draft_.facet_of[at(q)] >= 0) continue;
      draft_.facet_of[at(q)] = facet;
      patch.push_back(q);
    }
  }

  [[nodiscard]] bool is_kept_apart(int polygon) const {
    return !is_apart_.empty() && is_apart_[at(polygon)] != 0;
  }

  /// What is connected over edges is one component, numbered by its first polygon.
  void number_components() {
    Numbers component_of(soup_.polygons.size(), -1), reached;
    reached.reserve(soup_.polygons.size());
    std::size_t seen = 0;
    for (int start = 0; reached.size() < soup_.polygons.size(); ++start) {
      if (component_of[at(start)] >= 0) continue;
      component_of[at(start)] = draft_.components;
      reached.push_back(start);
      while (seen < reached.size() && reached.size() < soup_.polygons.size())
        reach_over(reached[seen++], component_of, reached);
      ++draft_.components;
    }
    draft_.component.resize(draft_.facet_count());
    for (std::size_t p = 0; p < component_of.size(); ++p)
      draft_.component[at(draft_.facet_of[p])] = component_of[p];
  }

  /// Takes the neighbours of a polygon into its component.
  void reach_over(int polygon, Numbers& component_of, Numbers& reached) const {
    const int begin = soup_.first_corner[at(soup_.first_ring[at(polygon)])];
    const int end = soup_.first_corner[at(soup_.first_ring[at(polygon) + 1])];
    for (int h = begin; h < end; ++h) {
      const int q = mesh_.polygon_of[at(mesh_.twin[at(h)])];
      if (component_of[at(q)] >= 0) continue;
      component_of[at(q)] = component_of[at(polygon)];
      reached.push_back(q);
    }
  }

  /// All loops with all their vertices, in the order of the edges that they start with.
  void find_loops() {
    vertices_.resize(mesh_.half_edge_count());
    first_vertex_.push_back(0);
    const int* const twin = mesh_.twin.data();
    const HalfEdgeState* const side = side_.data();
    const int count = static_cast<int>(mesh_.half_edge_count());
    for (int h = 0; h < count; ++h) {
      if (twin[h] < h || side[h] == HalfEdgeState::interior) continue;
      if (side[h] == HalfEdgeState::rim) walk_loop(h);
      if (side[twin[h]] == HalfEdgeState::rim) walk_loop(twin[h]);
    }
    vertices_.resize(at(first_vertex_.back()));
  }

  void walk_loop(int start) {
    facet_of_loop_.push_back(facet_of(start));
    const int *const next = mesh_.next.data(), *const vertex_of = mesh_.vertex_of.data();
    HalfEdgeState* const side = side_.data();
    int* vertex = vertices_.data() + first_vertex_.back();
    int h = start;
    do {
      side[h] = HalfEdgeState::walked;
      *vertex++ = vertex_of[h];
      h = next[h];
      while (side[h] == HalfEdgeState::interior) h = next[mesh_.twin[at(h)]];
    } while (h != start);
    first_vertex_.push_back(static_cast<int>(vertex - vertices_.data()));
  }

  [[nodiscard]] std::size_t loop_count() const { return facet_of_loop_.size(); }
  [[nodiscard]] std::span<const int> loop(std::size_t l) const {
    return {vertices_.data() + first_vertex_[l], vertices_.data() + first_vertex_[l + 1]};
  }

  /// A vertex is kept if three facets or more meet at it. A loop that would keep fewer than three
  /// keeps all, and so may its neighbours then. Where two edges would run from the same vertex to
  /// the same other one, all between them is kept: an edge is known by its ends.
  void choose_vertices() {
    Numbers degree(mesh_.vertex_count(), 0);
    for (const int v : vertices_) ++degree[at(v)];
    is_kept_.resize(degree.size());
    for (std::size_t v = 0; v < degree.size(); ++v) is_kept_[v] = degree[v] == 0 || degree[v] > 2;
    for (bool has_changed = true; has_changed && !are_all_kept();) {
      has_changed = false;
      for (std::size_t l = 0; l < loop_count(); ++l) {
        const auto kept =
            std::ranges::count_if(loop(l), [&](int v) { return is_kept_[at(v)] != 0; });
        if (kept >= 3 || kept == std::ssize(loop(l))) continue;
        for (const int v : loop(l)) is_kept_[at(v)] = 1;
        has_changed = true;
      }
      has_changed |= keep_between_equal_ends();
    }
  }

  [[nodiscard]] bool are_all_kept() const {
    return std::ranges::find(is_kept_, 0) == is_kept_.end();
  }

  /// An edge of a loop between kept vertices.
  struct Edge {
    int from, to;
    std::size_t loop;
    std::size_t start;  ///< the place of `from` in the loop
    bool is_long;       ///< it runs past vertices that are left out
  };

  /// Of a loop with kept vertices.
  void append_edges(std::size_t l, std::vector<Edge>& edges) const {
    const auto vertices = loop(l);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (!is_kept_[at(vertices[i])]) continue;
      std::size_t next = i + 1;
      while (!is_kept_[at(vertices[next % vertices.size()])]) ++next;
      edges.push_back({vertices[i], vertices[next % vertices.size()], l, i, next > i + 1});
    }
  }

  /// The edges that may have the same ends as another one. The mesh has no two edges with the same
  /// ends, so of two such edges here at least one is long.
  [[nodiscard]] std::vector<Edge> doubtful_edges() const {
    std::vector<Edge> edges;
    for (std::size_t l = 0; l < loop_count(); ++l) append_edges(l, edges);
    std::vector<char> starts_long(is_kept_.size(), 0);
    for (const Edge& edge : edges)
      if (edge.is_long) starts_long[at(edge.from)] = 1;
    std::erase_if(edges, [&](const Edge& edge) { return !starts_long[at(edge.from)]; });
    return edges;
  }

  /// Of edges with the same ends keeps the vertices between; true if there were any.
  bool keep_between_equal_ends() {
    std::vector<Edge> edges = doubtful_edges();
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::pair(e.from, e.to); });
    bool has_changed = false;
    const auto keep_between = [&](const Edge& edge) {
      const auto vertices = loop(edge.loop);
      for (std::size_t i = edge.start + 1;; ++i) {
        const int v = vertices[i % vertices.size()];
        if (v == edge.to) return;
        is_kept_[at(v)] = 1;
        has_changed = true;
      }
    };
    for (std::size_t i = 1; i < edges.size(); ++i) {
      if (std::pair(edges[i - 1].from, edges[i - 1].to) != std::pair(edges[i].from, edges[i].to))
        continue;
      keep_between(edges[i - 1]);
      keep_between(edges[i]);
    }
    return has_changed;
  }

  /// The loops by facet, with the vertices that are kept.
  void collect_loops() {
    Buckets loops_of_facet = sort_into_buckets(facet_of_loop_, draft_.facet_count());
    draft_.vertices.resize(vertices_.size());
    draft_.first_vertex.resize(loop_count() + 1);
    int* const kept = draft_.vertices.data();
    int* first = draft_.first_vertex.data();
    int count = 0;
    *first = 0;
    for (const int l : loops_of_facet.items) {
      for (const int v : loop(at(l))) {
        kept[count] = v;
        count += is_kept_[at(v)];
      }
      *++first = count;
    }
    draft_.vertices.resize(at(count));
    draft_.first_loop = std::move(loops_of_facet.first);
  }

  const Soup& soup_;
  const PlaneClusters& clusters_;
  const ShellMesh& mesh_;
  std::span<const char> is_apart_;
  FacetDraft draft_;
  /// What lies on the other side of a half-edge: its own facet, or another one; whether a loop went
  /// along it.
  enum class HalfEdgeState : char { interior, rim, walked };
  std::vector<HalfEdgeState> side_;
  // The loops as found: of each its facet, its first vertex (one entry more), all vertices.
  Numbers facet_of_loop_, first_vertex_, vertices_;
  std::vector<char> is_kept_;  ///< 1 for those on no loop, too
};

}  // namespace

FacetDraft draft_facets(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& mesh,
                        std::span<const char> is_apart) {
  ORIEL_ASSERT(clusters.plane_of.size() == soup.polygons.size());
  ORIEL_ASSERT(mesh.half_edge_count() == soup.corners.size(), "the mesh is of another soup");
  return Drafter(soup, clusters, mesh, is_apart).run();
}

}  // namespace oriel::detail
