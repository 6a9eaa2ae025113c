#pragma once

#include "kernel/segment/boundary/boundary.h"

#include <utility>
#include <vector>

namespace oriel::detail {

/// Copies facets with their half-edges into a boundary of their own. Turned round, air becomes a
/// body. Only one copier at a time may be in use.
class FacetCopier {
 public:
  FacetCopier(const Boundary& from, bool is_turned)
      : from_(from), to_(from.world()), scratch_(from.world().scratch), is_turned_(is_turned) {}

  void add(const std::vector<int>& facets);

  /// Of a half-edge of the facets.
  [[nodiscard]] int copy_of(int e) const { return scratch_.copy_of.find(e); }
  Boundary& boundary() { return to_; }

 private:
  void add(int f);

  const Boundary& from_;
  Boundary to_;
  Scratch& scratch_;
  bool is_turned_;
  // Of the loop at hand.
  std::vector<int> origins_;
  std::vector<std::pair<int, int>> pairs_;  ///< copies of both sides of edges
};

}  // namespace oriel::detail
