#include "kernel/segment/detail/facet_copier.h"

#include "kernel/model/detail/index.h"

namespace oriel::detail {

void FacetCopier::add(const std::vector<int>& facets) {
  scratch_.copied_edges.start(from_.half_edge_count());
  if (std::ssize(scratch_.copy_of) < from_.half_edge_count())
    scratch_.copy_of.resize(at(from_.half_edge_count()));
  int edges = 0;
  for (const int f : facets) from_.for_each_edge(f, [&](int) { ++edges; });
  to_.reserve(2 * edges, static_cast<int>(facets.size()) + 2);
  for (const int f : facets) add(f);
  for (const int f : facets) pair_twins(f);
}

void FacetCopier::add(int f) {
  const auto& facet = from_.facet(f);
  const int copy =
      to_.add_facet(is_turned_ ? facet.side ^ 1 : facet.side, facet.sources, facet.marks);
  for (const int l : facet.loops) {
    origins_.clear();
    int one = to_.half_edge_count();
    const int first = from_.loop(l).first;
    int e = first;
    do {
      origins_.push_back(is_turned_ ? from_.target(e) : from_.origin(e));
      scratch_.copied_edges.insert(e);
      scratch_.copy_of[at(e)] = one++;
      e = from_.next(e);
    } while (e != first);
    to_.add_cycle(origins_, copy, is_turned_);
  }
}

/// Pairs the copies of edges whose two sides are both copied.
void FacetCopier::pair_twins(int f) {
  from_.for_each_edge(f, [&](int e) {
    const int twin = from_.twin(e);
    if (e < twin && scratch_.copied_edges.contains(twin)) to_.pair(copy_of(e), copy_of(twin));
  });
}

}  // namespace oriel::detail
