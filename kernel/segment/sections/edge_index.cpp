#include "kernel/segment/sections/edge_index.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <numeric>

namespace oriel::detail {

EdgeIndex::EdgeIndex(const Boundary& body, std::span<const int> planes) : body_(body) {
  ORIEL_ASSERT(std::ranges::is_sorted(planes));
  // Planes are numbered class by class, and in a class by rank.
  const PlaneTable& table = body.world().planes;
  places_.reserve(planes.size());
  classes_.reserve(std::min(planes.size(), at(table.class_count())));
  for (const int plane : planes) {
    if (classes_.empty() || classes_.back().number != table.class_of(plane))
      classes_.push_back({table.class_of(plane), {}});
    places_.push_back({classes_.size() - 1, classes_.back().ranks.size()});
    classes_.back().ranks.push_back(table.rank_of(plane));
  }
  update();
}

void EdgeIndex::update() {
  const int count = body_.half_edge_count();
  if (known_ == 0) edges_.reserve(at(count) / 2);
  for (int number = known_; number < count; ++number) {
    const EdgeId e{number};
    if (!body_.is_alive_edge(e)) continue;
    const EdgeId twin = body_.twin(e);
    // Of two new half-edges the first speaks for both.
    if (twin.value >= known_ && twin < e) continue;
    edges_.push_back({e, body_.origin(e), body_.origin(twin)});
  }
  known_ = count;
}

/// Takes in the edges that came since the last time.
void EdgeIndex::enter(EdgesOfClass& c) {
  if (!c.ranks.is_ready()) make_table(c);
  find_new_runs(c);
  if (c.entered == 0) {
    std::vector<int> sizes(c.ranks.size() + 2, 0);
    for (const GapRun& run : runs_) {
      ++sizes[run.first];
      --sizes[run.last + 1];
    }
    std::partial_sum(sizes.begin(), sizes.end(), sizes.begin());
    sizes.pop_back();
    c.lists.make(sizes);
    for (const GapRun& run : runs_) c.lists.push_back_in_room(run.first, run.last, run.half);
  } else {
    for (const GapRun& run : runs_) c.lists.push_back(run.first, run.last, run.half);
  }
  c.entered = edges_.size();
}

void EdgeIndex::make_table(EdgesOfClass& c) const {
  c.ranks.make_table(body_.world().planes.normal_class(c.number).planes.size());
}

void EdgeIndex::find_new_runs(const EdgesOfClass& c) {
  const auto edges = std::span<const IndexedEdge>(edges_).subspan(c.entered);
  runs_.clear();
  runs_.reserve(edges.size());
  const auto rank = body_.world().points.ranks(c.number);
  std::size_t entries = 0;
  for (const IndexedEdge& edge : edges) {
    const auto [low, high] = std::minmax({rank[edge.from], rank[edge.to]});
    if (low == high) continue;
    runs_.push_back({edge.half, c.ranks.before(low + 1), c.ranks.before(high)});
    entries += runs_.back().last - runs_.back().first + 1;
  }
  body_.world().work.add_flat(static_cast<std::int64_t>(entries));
}

}  // namespace oriel::detail
