#include "kernel/segment/complex/refine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace oriel {

namespace {

/// Chords between the same two vertices are one edge; what adds up to nothing is left out.
std::vector<PlanarEdge> combined(std::vector<Chord> chords) {
  for (Chord& chord : chords)
    if (chord.from > chord.to) {
      std::swap(chord.from, chord.to);
      chord.count = -chord.count;
    }
  std::ranges::sort(chords, {}, [](const Chord& c) {
    return std::pair{std::pair{c.from, c.to}, c.label};
  });
  std::vector<PlanarEdge> edges;
  const auto drop_zeros = [&] {
    if (edges.empty()) return;
    std::erase_if(edges.back().windings, [](const auto& w) { return w.second == 0; });
    if (edges.back().windings.empty()) edges.pop_back();
  };
  int a = -1, b = -1;
  for (const Chord& chord : chords) {
    if (chord.from != a || chord.to != b) {
      drop_zeros();
      edges.push_back({a = chord.from, b = chord.to, {}});
    }
    auto& windings = edges.back().windings;
    if (windings.empty() || windings.back().first != chord.label)
      windings.emplace_back(chord.label, 0);
    windings.back().second += chord.count;
  }
  drop_zeros();
  return edges;
}

/// What an edge takes in a round, and each pair whose boxes overlap.
constexpr std::int64_t kStepsPerEdge = 16, kStepsPerLook = 4;

/// One round of cutting: finds all vertices that lie on edges and all crossings.
class Round {
 public:
  Round(std::span<const PlanarEdge> edges, const PlaneAxes& axes, VertexPool& pool, Work& work)
      : edges_(edges), axes_(axes), pool_(pool), work_(work), cuts_(edges.size()) {
    work_.add(kStepsPerEdge * std::ssize(edges));
    spans_.reserve(edges.size());
    for (const PlanarEdge& edge : edges) spans_.push_back(span_of(edge));
    sort_along_longer_axis();
    for (std::size_t i = 0; i < order_.size() && !work_.is_used_up(); ++i) look_ahead(i);
  }

  [[nodiscard]] bool has_cuts() const { return has_cuts_; }

  /// The edges as chords, cut.
  [[nodiscard]] std::vector<Chord> chords() {
    std::vector<Chord> chords;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const PlanarEdge& edge = edges_[e];
      const EdgeInPlane& span = spans_[e];
      std::vector<int>& cuts = cuts_[e];
      std::ranges::sort(cuts, {}, [&](int v) {
        return std::pair{dot(axes_(pool_.at(v)) - span.a, span.b - span.a), v};
      });
      // Two cuts beside each other may be as far apart as the ends: one waits for the next round.
      int from = edge.a;
      std::erase_if(cuts, [&](int to) {
        const bool is_kept =
            to != from && length(axes_(pool_.at(to)) - axes_(pool_.at(from))) < span.length;
        if (is_kept) from = to;
        return !is_kept;
      });
      cuts.push_back(edge.b);
      from = edge.a;
      for (const int to : cuts) {
        for (const auto& [label, count] : edge.windings) chords.push_back({from, to, label, count});
        from = to;
      }
    }
    return chords;
  }

 private:
  struct EdgeInPlane {
    Vec2 a, b;
    Vec2 min, max;  ///< its box, grown by the pool's reach
    double length;
  };

  [[nodiscard]] EdgeInPlane span_of(const PlanarEdge& edge) const {
    const Vec2 a = axes_(pool_.at(edge.a)), b = axes_(pool_.at(edge.b));
    const double reach = pool_.reach_m();
    return {a,
            b,
            {std::min(a.x, b.x) - reach, std::min(a.y, b.y) - reach},
            {std::max(a.x, b.x) + reach, std::max(a.y, b.y) + reach},
            length(b - a)};
  }

  /// A sweep looks at fewer pairs along the axis on which things are spread wider.
  void sort_along_longer_axis() {
    Vec2 min{Box::kInfinity, Box::kInfinity}, max{-Box::kInfinity, -Box::kInfinity};
    for (const EdgeInPlane& span : spans_) {
      min = {std::min(min.x, span.min.x), std::min(min.y, span.min.y)};
      max = {std::max(max.x, span.max.x), std::max(max.y, span.max.y)};
      order_.push_back(order_.size());
    }
    is_along_y_ = max.y - min.y > max.x - min.x;
    std::ranges::sort(order_, {}, [&](std::size_t e) { return std::pair{begin_of(e), e}; });
  }
  [[nodiscard]] double begin_of(std::size_t e) const {
    return is_along_y_ ? spans_[e].min.y : spans_[e].min.x;
  }
  [[nodiscard]] double end_of(std::size_t e) const {
    return is_along_y_ ? spans_[e].max.y : spans_[e].max.x;
  }

  void look_ahead(std::size_t i) {
    const std::size_t e = order_[i];
    const EdgeInPlane& mine = spans_[e];
    for (std::size_t j = i + 1; j < order_.size(); ++j) {
      const std::size_t other = order_[j];
      work_.add(1);
      if (begin_of(other) > end_of(e)) return;
      const EdgeInPlane& its = spans_[other];
      if (its.min.y > mine.max.y || mine.min.y > its.max.y || its.min.x > mine.max.x ||
          mine.min.x > its.max.x)
        continue;
      look_at(e, other);
    }
  }

  void look_at(std::size_t e, std::size_t f) {
    work_.add(kStepsPerLook);
    bool has_met = false;
    for (const int v : {edges_[f].a, edges_[f].b}) has_met |= meet_vertex(e, v);
    for (const int v : {edges_[e].a, edges_[e].b}) has_met |= meet_vertex(f, v);
    if (!has_met) meet_edge(e, f);
  }

  /// Cuts edge e at a vertex that lies on it. True if it is the edge's end, or lies on it.
  bool meet_vertex(std::size_t e, int vertex) {
    if (vertex == edges_[e].a || vertex == edges_[e].b) return true;
    const EdgeInPlane& span = spans_[e];
    const Vec2 at = axes_(pool_.at(vertex));
    if (std::abs(cross(span.b - span.a, at - span.a)) > pool_.reach_m() / 2 * span.length)
      return false;
    if (!is_shortened_by(e, at)) return false;
    cut(e, vertex);
    return true;
  }

  /// True if both pieces are shorter than the whole.
  [[nodiscard]] bool is_shortened_by(std::size_t e, Vec2 at) const {
    const EdgeInPlane& span = spans_[e];
    return length(at - span.a) < span.length && length(span.b - at) < span.length;
  }

  void meet_edge(std::size_t e, std::size_t f) {
    const EdgeInPlane &p = spans_[e], &q = spans_[f];
    const double fa = cross(p.b - p.a, q.a - p.a), fb = cross(p.b - p.a, q.b - p.a);
    const double ea = cross(q.b - q.a, p.a - q.a), eb = cross(q.b - q.a, p.b - q.a);
    if ((fa > 0) == (fb > 0) || (ea > 0) == (eb > 0)) return;
    const Vec3 from = pool_.at(edges_[e].a), to = pool_.at(edges_[e].b);
    const Vec3 point = from + (ea / (ea - eb)) * (to - from);
    auto vertex = pool_.find(point);
    const bool is_cut = vertex
                            ? fits(e, *vertex) && fits(f, *vertex)
                            : is_shortened_by(e, axes_(point)) && is_shortened_by(f, axes_(point));
    if (!is_cut) return;
    if (!vertex) vertex = pool_.add(point);
    for (const std::size_t edge : {e, f})
      if (*vertex != edges_[edge].a && *vertex != edges_[edge].b) cut(edge, *vertex);
  }
  [[nodiscard]] bool fits(std::size_t e, int vertex) const {
    return vertex == edges_[e].a || vertex == edges_[e].b ||
           is_shortened_by(e, axes_(pool_.at(vertex)));
  }

  void cut(std::size_t e, int vertex) {
    cuts_[e].push_back(vertex);
    has_cuts_ = true;
  }

  std::span<const PlanarEdge> edges_;
  const PlaneAxes& axes_;
  VertexPool& pool_;
  Work& work_;
  std::vector<EdgeInPlane> spans_;
  std::vector<std::size_t> order_;
  bool is_along_y_ = false;
  std::vector<std::vector<int>> cuts_;
  bool has_cuts_ = false;
};

}  // namespace

std::vector<PlanarEdge> refine(std::vector<Chord> chords, const PlaneAxes& axes, VertexPool& pool,
                               Work& work) {
  std::vector<PlanarEdge> edges = combined(std::move(chords));
  while (true) {
    Round round(edges, axes, pool, work);
    if (work.is_used_up()) return {};
    if (!round.has_cuts()) return edges;
    edges = combined(round.chords());
  }
}

}  // namespace oriel
