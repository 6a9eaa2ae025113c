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
    Class c{number, {}, {}};
    for (const auto& [rank, entry] : members) {
      c.ranks.push_back(rank);
      c.entries.push_back(entry);
    }
    classes_.push_back(std::move(c));
  }
  update();
}

void EdgeIndex::update() {
  const int count = body_.half_edge_count();
  for (const Class& c : classes_) {
    const auto rank = body_.world().points.ranks(c.number);
    const auto rank_of = [&](int e) { return rank[static_cast<std::size_t>(body_.origin(e))]; };
    for (int e = known_; e < count; ++e) {
      if (!body_.is_alive_edge(e)) continue;
      const int twin = body_.twin(e);
      // Of two new half-edges the first speaks for both.
      if (twin >= known_ && twin < e) continue;
      const auto [low, high] = std::minmax({rank_of(e), rank_of(twin)});
      if (low == high) continue;
      for (auto i = std::ranges::lower_bound(c.ranks, low) - c.ranks.begin();
           i < std::ssize(c.ranks) && c.ranks[static_cast<std::size_t>(i)] <= high; ++i)
        edges_[c.entries[static_cast<std::size_t>(i)]].push_back(e);
    }
  }
  known_ = count;
}

}  // namespace oriel::detail
