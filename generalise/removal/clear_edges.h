#pragma once

#include "generalise/carry_out.h"
#include "generalise/invariants/fineness.h"
#include "generalise/invariants/invariants.h"
#include "model/solid.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// What is to be cleared, and what may go for it.
struct ClearOrder {
  /// The edges of a solid that are to go.
  std::function<std::vector<ShortEdge>(const Solid&)> short_edges_of;
  /// Why a facet of a solid has to stay ("it is part of a feature that stays"), or nothing.
  std::function<std::optional<std::string>(const Solid&, const Facet&)> keeps_facet;
  /// Corners move by no more.
  double reach_m = 0;
};

struct Cleared {
  Solid solid;
  std::vector<UnclearedEdge> left;
};

/// Clears a solid of edges that are too short: a facet of three or four corners at such an edge
/// goes (drop_facet), and those beside it are made longer until they meet, as long as fewer edges
/// are too short after that, the solid is as fit by the validator as it was, and the validator
/// finds no violation. One facet after the other, those at the first edge first, of these the one
/// with fewer corners first. Without a validator nothing goes. What is left comes with the reason
/// why the first of the facets at it could not go. Source: docs/generalisation.md, Fineness.
Cleared clear_edges(Solid solid, const ClearOrder& order, const SolidValidator& validator);

}  // namespace oriel
