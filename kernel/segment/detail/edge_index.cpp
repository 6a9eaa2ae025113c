#include "kernel/segment/detail/edge_index.h"

#include <algorithm>
#include <map>

namespace oriel::detail {

EdgeIndex::EdgeIndex(const Boundary& body, const std::vector<int>& planes)
    : body_(body), edges_(planes.size()) {
  const PlaneTable& table = body.world().planes;
  std::map<int, std::vector<std::pair<int, std::size_t>>> by_class;
  for (std::size_t i = 0; i < planes.size(); ++i)
    by_class[table.class_of(planes[i])].emplace_back(table.rank_of(planes[i]), i);
  for (auto& [number, members] : by_class) {
    std::ranges::sort(members);
    Class c{number, {}, {}, {}};
    for (const auto& [rank, entry] : members) {
      c.ranks.push_back(rank);
      c.entries.push_back(entry);
    }
    constexpr std::size_t kMany = 8;  // times: then searching costs less than a table
    const std::size_t ranks = 2 * table.normal_class(number).planes.size() + 1;
    if (ranks <= kMany * c.ranks.size())
      for (std::size_t rank = 0, i = 0; rank <= ranks; ++rank) {
        while (i < c.ranks.size() && c.ranks[i] < static_cast<int>(rank)) ++i;
        c.first.push_back(static_cast<int>(i));
      }
    classes_.push_back(std::move(c));
  }
  update();
}

std::size_t EdgeIndex::Class::first_from(int rank) const {
  if (!first.empty()) return static_cast<std::size_t>(first[static_cast<std::size_t>(rank)]);
  return static_cast<std::size_t>(std::ranges::lower_bound(ranks, rank) - ranks.begin());
}

void EdgeIndex::update() {
  struct Edge {
    int half, from, to;
  };
  const int count = body_.half_edge_count();
  std::vector<Edge> edges;
  edges.reserve(static_cast<std::size_t>(count - known_));
  for (int e = known_; e < count; ++e) {
    if (!body_.is_alive_edge(e)) continue;
    const int twin = body_.twin(e);
    // Of two new half-edges the first speaks for both.
    if (twin >= known_ && twin < e) continue;
    edges.push_back({e, body_.origin(e), body_.origin(twin)});
  }
  for (const Class& c : classes_) {
    const auto rank = body_.world().points.ranks(c.number);
    for (const Edge& edge : edges) {
      const int from = rank[static_cast<std::size_t>(edge.from)];
      const int to = rank[static_cast<std::size_t>(edge.to)];
      if (from == to) continue;
      const int high = std::max(from, to);
      for (std::size_t i = c.first_from(std::min(from, to));
           i < c.ranks.size() && c.ranks[i] <= high; ++i)
        edges_[c.entries[i]].push_back(edge.half);
    }
  }
  known_ = count;
}

}  // namespace oriel::detail
