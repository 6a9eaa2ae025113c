#include "kernel/solidify/detail/facets.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Disjoint sets of polygons; `number` gives every set a number, counted in the order of first
/// members.
class Groups {
 public:
  explicit Groups(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void unite(int i, int j) {
    i = find(i);
    j = find(j);
    parent_[at(std::max(i, j))] = std::min(i, j);
  }
  std::vector<int> number(int& count) {
    std::vector<int> of_root(parent_.size(), -1), out(parent_.size());
    count = 0;
    for (int i = 0; i < std::ssize(parent_); ++i) {
      int& n = of_root[at(find(i))];
      if (n < 0) n = count++;
      out[at(i)] = n;
    }
    return out;
  }

 private:
  std::vector<int> parent_;
};

class Drafter {
 public:
  Drafter(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& shell)
      : soup_(soup), clusters_(clusters), shell_(shell) {}

  FacetDraft run() {
    group_polygons();
    find_loops();
    choose_vertices();
    FacetDraft draft;
    draft.facets.resize(at(facet_count_));
    draft.component.resize(at(facet_count_));
    draft.components = component_count_;
    for (int p = 0; p < std::ssize(soup_.polygons); ++p) {
      const std::size_t f = at(facet_of_[at(p)]);
      draft.facets[f].plane = PlaneId{clusters_.plane_of[at(p)]};
      draft.facets[f].polygons.push_back(soup_.polygons[at(p)].source);
      draft.component[f] = component_of_[at(p)];
    }
    for (Facet& facet : draft.facets) std::ranges::sort(facet.polygons);
    for (const auto& [facet, loop] : loops_) {
      Loop kept;
      for (const int v : loop)
        if (is_kept_[at(v)]) kept.push_back(v);
      draft.facets[at(facet)].loops.push_back(std::move(kept));
    }
    return draft;
  }

 private:
  using Mesh = ShellMesh::Mesh;
  using Halfedge = OpenMesh::HalfedgeHandle;

  [[nodiscard]] int polygon_of(Halfedge h) const {
    return shell_.polygon_of[at(shell_.mesh.face_handle(h).idx())];
  }
  [[nodiscard]] int facet_of(Halfedge h) const { return facet_of_[at(polygon_of(h))]; }
  [[nodiscard]] Halfedge twin(Halfedge h) const { return shell_.mesh.opposite_halfedge_handle(h); }
  /// Two facets meet here.
  [[nodiscard]] bool is_rim(Halfedge h) const { return facet_of(h) != facet_of(twin(h)); }

  void group_polygons() {
    Groups facets(soup_.polygons.size()), components(soup_.polygons.size());
    for (const auto e : shell_.mesh.edges()) {
      const Halfedge h = shell_.mesh.halfedge_handle(e, 0);
      const int p = polygon_of(h), q = polygon_of(twin(h));
      components.unite(p, q);
      if (clusters_.plane_of[at(p)] == clusters_.plane_of[at(q)]) facets.unite(p, q);
    }
    facet_of_ = facets.number(facet_count_);
    component_of_ = components.number(component_count_);
  }

  void find_loops() {
    std::vector<char> is_seen(shell_.mesh.n_halfedges(), 0);
    for (const auto start : shell_.mesh.halfedges()) {
      if (is_seen[at(start.idx())] || !is_rim(start)) continue;
      Loop loop;
      Halfedge h = start;
      do {
        is_seen[at(h.idx())] = 1;
        loop.push_back(shell_.mesh.from_vertex_handle(h).idx());
        h = shell_.mesh.next_halfedge_handle(h);
        while (!is_rim(h)) h = shell_.mesh.next_halfedge_handle(twin(h));
      } while (h != Halfedge(start));
      loops_.emplace_back(facet_of(start), std::move(loop));
    }
  }

  /// A vertex is kept if three facets or more meet at it. A loop that would keep fewer than three
  /// keeps all, and so may its neighbours then. Where two edges would run from the same vertex to
  /// the same other one, all between them is kept: an edge is known by its ends.
  void choose_vertices() {
    std::vector<int> degree(shell_.mesh.n_vertices(), 0);
    for (const auto h : shell_.mesh.halfedges())
      if (is_rim(h)) ++degree[at(shell_.mesh.from_vertex_handle(h).idx())];
    is_kept_.resize(degree.size());
    for (std::size_t v = 0; v < degree.size(); ++v) is_kept_[v] = degree[v] > 2;
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (const auto& [facet, loop] : loops_) {
        const auto kept = std::ranges::count_if(loop, [&](int v) { return is_kept_[at(v)] != 0; });
        if (kept >= 3 || kept == std::ssize(loop)) continue;
        for (const int v : loop) is_kept_[at(v)] = 1;
        has_changed = true;
      }
      has_changed |= keep_between_equal_ends();
    }
  }

  /// Of edges with the same ends keeps the vertices between; true if there were any.
  bool keep_between_equal_ends() {
    struct Edge {
      int from, to;
      const Loop* loop;
      std::size_t start;  ///< the place of `from` in the loop
    };
    std::vector<Edge> edges;
    for (const auto& [facet, loop] : loops_)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        if (!is_kept_[at(loop[i])]) continue;
        std::size_t next = i + 1;
        while (!is_kept_[at(loop[next % loop.size()])]) ++next;
        edges.push_back({loop[i], loop[next % loop.size()], &loop, i});
      }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::pair(e.from, e.to); });
    bool has_changed = false;
    const auto keep_between = [&](const Edge& edge) {
      for (std::size_t i = edge.start + 1;; ++i) {
        const int v = (*edge.loop)[i % edge.loop->size()];
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

  const Soup& soup_;
  const PlaneClusters& clusters_;
  const ShellMesh& shell_;
  std::vector<int> facet_of_, component_of_;
  int facet_count_ = 0, component_count_ = 0;
  std::vector<std::pair<int, Loop>> loops_;
  std::vector<char> is_kept_;
};

}  // namespace

FacetDraft draft_facets(const Soup& soup, const PlaneClusters& clusters, const ShellMesh& shell) {
  return Drafter(soup, clusters, shell).run();
}

}  // namespace oriel::detail
