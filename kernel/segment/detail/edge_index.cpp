#include "kernel/segment/detail/edge_index.h"

#include "kernel/model/detail/index.h"

#include <algorithm>
#include <numeric>

namespace oriel::detail {

EdgeIndex::EdgeIndex(const Boundary& body, const std::vector<int>& planes) : body_(body) {
  // Planes are numbered class by class, and in a class by rank.
  const PlaneTable& table = body.world().planes;
  first_gaps_.reserve(planes.size());
  for (const int plane : planes) {
    if (classes_.empty() || classes_.back().number != table.class_of(plane))
      classes_.push_back({table.class_of(plane), {}, gaps_++, {}});
    classes_.back().ranks.push_back(table.rank_of(plane));
    first_gaps_.push_back(gaps_++ - 1);
  }
  make_tables();
  update();
}

void EdgeIndex::make_tables() {
  constexpr std::size_t kMany = 8;  // times: then searching costs less than a table
  for (Class& c : classes_) {
    const std::size_t ranks = 2 * body_.world().planes.normal_class(c.number).planes.size() + 2;
    if (ranks > kMany * c.ranks.size()) continue;
    c.before.reserve(ranks);
    for (int rank = 0, i = 0; rank < static_cast<int>(ranks); ++rank) {
      while (i < std::ssize(c.ranks) && c.ranks[at(i)] < rank) ++i;
      c.before.push_back(i);
    }
  }
}

std::size_t EdgeIndex::Class::planes_before(int rank) const {
  if (!before.empty()) return at(before[at(rank)]);
  return at(std::ranges::lower_bound(ranks, rank) - ranks.begin());
}

std::vector<EdgeIndex::Edge> EdgeIndex::new_edges() const {
  const int count = body_.half_edge_count();
  std::vector<Edge> edges;
  edges.reserve(at(count - known_));
  for (int e = known_; e < count; ++e) {
    if (!body_.is_alive_edge(e)) continue;
    const int twin = body_.twin(e);
    // Of two new half-edges the first speaks for both.
    if (twin >= known_ && twin < e) continue;
    edges.push_back({e, body_.origin(e), body_.origin(twin)});
  }
  return edges;
}

/// Class by class.
std::vector<EdgeIndex::Run> EdgeIndex::runs_of(std::span<const Edge> edges) const {
  std::vector<Run> runs;
  runs.reserve(edges.size() * classes_.size());
  for (const Class& c : classes_) {
    const auto rank = body_.world().points.ranks(c.number);
    for (const Edge& edge : edges) {
      const auto [low, high] = std::minmax(rank[at(edge.from)], rank[at(edge.to)]);
      if (low == high) continue;
      runs.push_back({edge.half, static_cast<int>(c.first_gap + c.planes_before(low + 1)),
                      static_cast<int>(c.first_gap + c.planes_before(high))});
    }
  }
  return runs;
}

void EdgeIndex::update() {
  const std::vector<Run> runs = runs_of(new_edges());
  if (known_ == 0) {
    std::vector<int> sizes(gaps_ + 1, 0);
    for (const Run& run : runs) {
      ++sizes[at(run.first)];
      --sizes[at(run.last) + 1];
    }
    std::partial_sum(sizes.begin(), sizes.end(), sizes.begin());
    edges_.make(std::span(sizes).first(gaps_));
  }
  for (const Run& run : runs) edges_.push_back(at(run.first), at(run.last), run.half);
  known_ = body_.half_edge_count();
}

}  // namespace oriel::detail
