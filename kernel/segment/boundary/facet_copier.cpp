#include "kernel/segment/boundary/facet_copier.h"

namespace oriel::detail {

void FacetCopier::add(const std::vector<int>& facets) {
  scratch_.copy_of.start(from_.half_edge_count());
  int edges = 0;
  for (const int f : facets) from_.for_each_edge(f, [&](int) { ++edges; });
  to_.reserve(2 * edges, static_cast<int>(facets.size()) + 2);
  for (const int f : facets) add(f);
}

void FacetCopier::add(int f) {
  const auto& facet = from_.facet(f);
  const int copy =
      to_.add_facet(is_turned_ ? facet.side ^ 1 : facet.side, facet.sources, facet.marks);
  for (const int l : facet.loops) {
    origins_.clear();
    pairs_.clear();
    int one = to_.half_edge_count();
    const int first = from_.loop(l).first;
    int e = first;
    do {
      origins_.push_back(is_turned_ ? from_.target(e) : from_.origin(e));
      scratch_.copy_of.set(e, one);
      // Whichever side comes last is paired.
      if (const int twin = copy_of(from_.twin(e)); twin >= 0) pairs_.emplace_back(one, twin);
      ++one;
      e = from_.next(e);
    } while (e != first);
    to_.add_cycle(origins_, copy, is_turned_);
    for (const auto& [one_side, other] : pairs_) to_.pair(one_side, other);
  }
}

}  // namespace oriel::detail
