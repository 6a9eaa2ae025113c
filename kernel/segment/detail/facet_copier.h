#pragma once

#include "kernel/segment/detail/boundary.h"

#include <vector>

namespace oriel::detail {

/// Copies facets with their half-edges into a boundary of their own. Turned round, air becomes a
/// body. Only one copier at a time may be in use.
class FacetCopier {
 public:
  FacetCopier(const Boundary& from, bool is_turned)
      : from_(from), to_(from.world()), scratch_(from.world().scratch), is_turned_(is_turned) {}

  void add(const std::vector<int>& facets);

  [[nodiscard]] int copy_of(int e) const { return scratch_.copy_of[static_cast<std::size_t>(e)]; }
  Boundary& boundary() { return to_; }

 private:
  void add(int f);
  void pair_twins(int f);

  const Boundary& from_;
  Boundary to_;
  Scratch& scratch_;
  bool is_turned_;
  std::vector<int> origins_;  ///< of the loop at hand
};

}  // namespace oriel::detail
