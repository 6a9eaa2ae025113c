#include "generalise/removal/cell_contacts.h"

#include "kernel/geometry/disjoint_sets.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace oriel::detail {

CellContacts::CellContacts(const CellComplex& complex, std::size_t cells) : cells_(cells) {
  std::vector<std::tuple<int, int, CellId>> at_edge;
  for (const Face& face : complex.faces())
    for (const Loop& loop : face.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const auto [low, high] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
        for (const CellId cell : {face.behind, face.front})
          if (cell.is_valid()) at_edge.emplace_back(low, high, cell);
      }
  std::ranges::sort(at_edge);
  at_edge.erase(std::unique(at_edge.begin(), at_edge.end()), at_edge.end());
  for (std::size_t i = 0; i < at_edge.size();) {
    const auto [low, high, first] = at_edge[i];
    std::vector<CellId> there;
    for (; i < at_edge.size() &&
           std::tuple(std::get<0>(at_edge[i]), std::get<1>(at_edge[i])) == std::tuple(low, high);
         ++i)
      there.push_back(std::get<2>(at_edge[i]));
    touching_.push_back(std::move(there));
  }
  std::ranges::sort(touching_);
  touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
}

int CellContacts::pieces_of(const std::vector<CellId>& some) const {
  std::vector<char> is_there(cells_, 0), is_met(cells_, 0);
  for (const CellId cell : some) is_there[cell.index()] = 1;
  DisjointSets sets(cells_);
  for (const std::vector<CellId>& touching : touching_) {
    CellId before;
    for (const CellId cell : touching) {
      if (is_there[cell.index()] == 0) continue;
      is_met[cell.index()] = 1;
      if (before.is_valid()) sets.unite(before.value, cell.value);
      before = cell;
    }
  }
  int pieces = 0;
  for (std::size_t i = 0; i < cells_; ++i)
    pieces += is_met[i] != 0 && sets.find(static_cast<int>(i)) == static_cast<int>(i) ? 1 : 0;
  return pieces;
}

}  // namespace oriel::detail
