#include "kernel/segment/complex/arrangement.h"

#include <algorithm>

namespace oriel {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// base + sign × change; both sorted by label.
Arrangement::Windings sum_of(const Arrangement::Windings& base, const Arrangement::Windings& change,
                             int sign) {
  Arrangement::Windings sum;
  auto b = base.begin();
  for (const auto& [label, count] : change) {
    while (b != base.end() && b->first < label) sum.push_back(*b++);
    const int before = b != base.end() && b->first == label ? (b++)->second : 0;
    if (before + sign * count != 0) sum.emplace_back(label, before + sign * count);
  }
  sum.insert(sum.end(), b, base.end());
  return sum;
}

}  // namespace

Arrangement::Arrangement(std::span<const PlanarEdge> edges, const PlaneAxes& axes,
                         const VertexPool& pool)
    : edges_(edges) {
  std::vector<int> vertices;
  for (std::size_t h = 0; h < half_edge_count(); ++h) vertices.push_back(origin(h));
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const int v : vertices) position_.push_back(axes(pool.at(v)));
  for (std::size_t h = 0; h < half_edge_count(); ++h)
    vertex_.push_back(
        static_cast<std::size_t>(std::ranges::lower_bound(vertices, origin(h)) - vertices.begin()));
  order_around_vertices();
  trace_cycles();
  nest();
}

void Arrangement::order_around_vertices() {
  std::vector<std::vector<std::size_t>> leaving(position_.size());
  for (std::size_t h = 0; h < half_edge_count(); ++h) leaving[vertex_[h]].push_back(h);
  next_.resize(half_edge_count());
  for (auto& around : leaving) {
    const auto direction = [&](std::size_t h) { return at(twin(h)) - at(h); };
    const auto is_upper = [](Vec2 d) { return d.y > 0 || (d.y == 0 && d.x > 0); };
    std::ranges::sort(around, [&](std::size_t g, std::size_t h) {
      const Vec2 p = direction(g), q = direction(h);
      if (is_upper(p) != is_upper(q)) return is_upper(p);
      return cross(p, q) > 0;
    });
    // Who arrives by the twin of one leaves by the one clockwise before it.
    for (std::size_t i = 0; i < around.size(); ++i)
      next_[twin(around[(i + 1) % around.size()])] = around[i];
  }
}

void Arrangement::trace_cycles() {
  cycle_.assign(half_edge_count(), kNone);
  for (std::size_t start = 0; start < half_edge_count(); ++start) {
    if (cycle_[start] != kNone) continue;
    Cycle cycle{start};
    double area = 0;
    for (std::size_t h = start; cycle_[h] == kNone; h = next_[h]) {
      cycle_[h] = cycles_.size();
      area += cross(at(h) - at(start), at(twin(h)) - at(start));
      if (at(h).x < at(cycle.leftmost).x) cycle.leftmost = h;
    }
    cycle.is_outer = area > 0;
    cycles_.push_back(cycle);
  }
}

/// Around each connected set of edges runs one cycle that is not outer: it belongs to the region
/// that the set lies in. Seen from the left: what is further left is known already.
void Arrangement::nest() {
  region_of_cycle_.assign(cycles_.size(), 0);
  std::vector<std::size_t> around;
  for (std::size_t c = 0; c < cycles_.size(); ++c)
    if (cycles_[c].is_outer)
      region_of_cycle_[c] = region_count_++;
    else
      around.push_back(c);
  std::ranges::stable_sort(around, {}, [&](std::size_t c) { return at(cycles_[c].leftmost).x; });
  for (const std::size_t c : around) {
    const std::size_t h = nearest_to_the_left(at(cycles_[c].leftmost));
    if (h != kNone) region_of_cycle_[c] = region(h);
  }
}

std::size_t Arrangement::nearest_to_the_left(Vec2 point) const {
  std::size_t nearest = kNone;
  Vec2 best;  // where it is, and its lean to the right above that
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const bool goes_up = at(2 * e).y < at(2 * e + 1).y;
    const std::size_t low = goes_up ? 2 * e : 2 * e + 1;
    const Vec2 from = at(low), to = at(twin(low));
    if (from.y > point.y || to.y <= point.y) continue;
    const double lean = (to.x - from.x) / (to.y - from.y);
    const Vec2 here{from.x + (point.y - from.y) * lean, lean};
    if (here.x >= point.x) continue;
    if (nearest != kNone && (here.x < best.x || (here.x == best.x && here.y <= best.y))) continue;
    nearest = twin(low);  // downward: what is to its right on the page is to its left
    best = here;
  }
  return nearest;
}

std::vector<Arrangement::Windings> Arrangement::windings() const {
  std::vector<std::vector<std::size_t>> around(region_count_);
  for (std::size_t h = 0; h < half_edge_count(); ++h) around[region(h)].push_back(h);
  std::vector<Arrangement::Windings> windings(region_count_);
  std::vector<char> is_known(region_count_, 0);
  is_known[0] = 1;
  std::vector<std::size_t> reached{0};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const std::size_t h : around[reached[i]]) {
      const std::size_t across = region(twin(h));
      if (is_known[across] != 0) continue;
      is_known[across] = 1;
      reached.push_back(across);
      // To the left of half-edge 2e the edge's labels hold more often.
      windings[across] = sum_of(windings[reached[i]], edges_[h / 2].windings, h % 2 == 0 ? -1 : 1);
    }
  return windings;
}

std::vector<std::vector<int>> Arrangement::labels() const {
  const std::vector<Arrangement::Windings> of_region = windings();
  std::vector<std::vector<int>> labels(region_count_);
  for (std::size_t r = 0; r < region_count_; ++r)
    for (const auto& [label, count] : of_region[r])
      if (count > 0) labels[r].push_back(label);
  return labels;
}

}  // namespace oriel
