#include "generalise/series/change.h"

#include "kernel/geometry/disjoint_sets.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <utility>

namespace oriel {

namespace {

template <class Map>
auto difference_of_maps(const Map& before, const Map& after) {
  std::map<std::string, std::optional<typename Map::mapped_type>> changed;
  for (const auto& [key, value] : before)
    if (!after.contains(key)) changed[key] = std::nullopt;
  for (const auto& [key, value] : after) {
    const auto old = before.find(key);
    if (old == before.end() || old->second != value) changed[key] = value;
  }
  return changed;
}

bool means_the_same(const LevelFacet& a, const LevelFacet& b) {
  return a.type == b.type && a.label == b.label && a.installations == b.installations;
}

void compare(const MicrometreRing& outer, const LevelFacet& before, const LevelFacet& after,
             Change& change) {
  if (before == after) return;
  if (!means_the_same(before, after)) {
    change.removed.emplace_back(outer, before);
    change.added.emplace_back(outer, after);
    return;
  }
  Change::Holes& holes = change.holes[outer];
  std::ranges::set_difference(before.holes, after.holes, std::back_inserter(holes.removed));
  std::ranges::set_difference(after.holes, before.holes, std::back_inserter(holes.added));
}

/// A piece of a change that stays whole: a facet or a hole.
struct ChangePiece {
  enum class Kind { removed, added, removed_hole, added_hole };
  Kind kind;
  std::size_t index = 0;                  ///< of a facet
  const MicrometreRing* outer = nullptr;  ///< of a hole
  const MicrometreRing* ring = nullptr;   ///< the hole, or the facet's outer ring
  const LevelFacet* facet = nullptr;      ///< of a facet
};

std::vector<ChangePiece> pieces_of(const Change& change) {
  std::vector<ChangePiece> pieces;
  for (std::size_t i = 0; i < change.removed.size(); ++i) {
    const auto& [outer, facet] = change.removed[i];
    pieces.push_back({ChangePiece::Kind::removed, i, nullptr, &outer, &facet});
  }
  for (std::size_t i = 0; i < change.added.size(); ++i) {
    const auto& [outer, facet] = change.added[i];
    pieces.push_back({ChangePiece::Kind::added, i, nullptr, &outer, &facet});
  }
  for (const auto& [outer, holes] : change.holes) {
    for (const MicrometreRing& ring : holes.removed)
      pieces.push_back({ChangePiece::Kind::removed_hole, 0, &outer, &ring, nullptr});
    for (const MicrometreRing& ring : holes.added)
      pieces.push_back({ChangePiece::Kind::added_hole, 0, &outer, &ring, nullptr});
  }
  return pieces;
}

void for_each_edge(
    const MicrometreRing& ring,
    const std::function<void(const std::pair<MicrometrePoint, MicrometrePoint>&)>& visit) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MicrometrePoint &p = ring[i], &q = ring[(i + 1) % ring.size()];
    visit(std::minmax(p, q));
  }
}

void put(const Change& change, const ChangePiece& piece, Change& part) {
  switch (piece.kind) {
    case ChangePiece::Kind::removed:
      part.removed.push_back(change.removed[piece.index]);
      return;
    case ChangePiece::Kind::added:
      part.added.push_back(change.added[piece.index]);
      return;
    case ChangePiece::Kind::removed_hole:
      part.holes[*piece.outer].removed.push_back(*piece.ring);
      return;
    case ChangePiece::Kind::added_hole:
      part.holes[*piece.outer].added.push_back(*piece.ring);
      return;
  }
}

template <class Map, class Changed>
void apply_to_map(Map& map, const Changed& changed) {
  for (const auto& [key, value] : changed) {
    map.erase(key);
    if (value) map.emplace(key, *value);
  }
}

bool apply_holes(std::map<MicrometreRing, LevelFacet>& facets, const MicrometreRing& outer,
                 const Change::Holes& change) {
  const auto facet = facets.find(outer);
  if (facet == facets.end()) return false;
  auto& holes = facet->second.holes;
  for (const MicrometreRing& ring : change.removed) {
    const auto found = std::ranges::lower_bound(holes, ring);
    if (found == holes.end() || *found != ring) return false;
    holes.erase(found);
  }
  for (const MicrometreRing& ring : change.added) {
    const auto place = std::ranges::lower_bound(holes, ring);
    if (place != holes.end() && *place == ring) return false;
    holes.insert(place, ring);
  }
  return true;
}

}  // namespace

Change difference(const LevelState& before, const LevelState& after) {
  Change change;
  for (const auto& [outer, facet] : before.facets)
    if (const auto same = after.facets.find(outer); same == after.facets.end())
      change.removed.emplace_back(outer, facet);
    else
      compare(outer, facet, same->second, change);
  for (const auto& [outer, facet] : after.facets)
    if (!before.facets.contains(outer)) change.added.emplace_back(outer, facet);
  change.installations = difference_of_maps(before.installations, after.installations);
  change.attributes = difference_of_maps(before.attributes, after.attributes);
  return change;
}

std::vector<Change> parts_of(const Change& change) {
  const std::vector<ChangePiece> pieces = pieces_of(change);
  DisjointSets sets(pieces.size());
  std::map<std::pair<MicrometrePoint, MicrometrePoint>, int> piece_at;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto join = [&](const std::pair<MicrometrePoint, MicrometrePoint>& edge) {
      const auto [first, is_new] = piece_at.emplace(edge, static_cast<int>(i));
      if (!is_new) sets.unite(first->second, static_cast<int>(i));
    };
    for_each_edge(*pieces[i].ring, join);
    if (pieces[i].facet != nullptr)
      for (const MicrometreRing& hole : pieces[i].facet->holes) for_each_edge(hole, join);
  }
  // A facet that gives way to another one with the same outer ring takes that one along, and so do
  // holes on it; they share its edges.
  std::map<int, Change> parts;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    put(change, pieces[i], parts[sets.find(static_cast<int>(i))]);
  std::vector<Change> out;
  for (auto& [number, part] : parts) out.push_back(std::move(part));
  return out;
}

void unite(Change& change, Change more) {
  std::ranges::move(more.removed, std::back_inserter(change.removed));
  std::ranges::move(more.added, std::back_inserter(change.added));
  for (auto& [outer, holes] : more.holes) {
    std::ranges::move(holes.removed, std::back_inserter(change.holes[outer].removed));
    std::ranges::move(holes.added, std::back_inserter(change.holes[outer].added));
  }
  change.installations.merge(more.installations);
  change.attributes.merge(more.attributes);
}

bool apply(LevelState& state, const Change& change) {
  for (const auto& [outer, facet] : change.removed) {
    const auto found = state.facets.find(outer);
    if (found == state.facets.end() || !(found->second == facet)) return false;
    state.facets.erase(found);
  }
  for (const auto& [outer, facet] : change.added)
    if (!state.facets.emplace(outer, facet).second) return false;
  for (const auto& [outer, holes] : change.holes)
    if (!apply_holes(state.facets, outer, holes)) return false;
  apply_to_map(state.installations, change.installations);
  apply_to_map(state.attributes, change.attributes);
  return true;
}

Box box_of(const Change& change) {
  Box box;
  const auto grow = [&](const MicrometreRing& ring) {
    for (const MicrometrePoint& p : ring) box.grow(metres_of(p));
  };
  for (const auto* facets : {&change.removed, &change.added})
    for (const auto& [outer, facet] : *facets) grow(outer);
  for (const auto& [outer, holes] : change.holes)
    for (const auto* rings : {&holes.removed, &holes.added}) std::ranges::for_each(*rings, grow);
  return box;
}

}  // namespace oriel
