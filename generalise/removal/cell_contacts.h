#pragma once

#include "model/cell_complex.h"

#include <cstddef>
#include <vector>

namespace oriel::detail {

/// Which cells of a complex hang together, by faces or edges.
class CellContacts {
 public:
  /// `cells`: how many the complex has.
  CellContacts(const CellComplex& complex, std::size_t cells);

  /// Counts the pieces that some cells are in; none of them counts as several.
  [[nodiscard]] int pieces_of(const std::vector<CellId>& some) const;

 private:
  std::size_t cells_;
  std::vector<std::vector<CellId>> touching_;  ///< at one edge, each set of them once
};

}  // namespace oriel::detail
