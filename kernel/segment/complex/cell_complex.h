#pragma once

#include "kernel/base/work.h"
#include "model/cell_complex.h"
#include "model/segmentation.h"
#include "model/tolerances.h"

#include <optional>

namespace oriel {

/// The cell complex of a segmentation: which cell meets which, and where.
///
/// In each plane the facets of all cells are overlaid with the sections of the cells that pass
/// through it; of each piece the tree says which cell lies on either side, and pieces with the same
/// two cells are one face. `tolerances` are those of the segmentation: points nearer than a quarter
/// of weld_m are one. Source: Thiemann & Sester 2004, section 4 ("cell
/// complex"); docs/segmentation.md#the-cell-complex.
CellComplex cell_complex(const Segmentation& segmentation, const Tolerances& tolerances = {});

/// The same, its work counted: nothing once that is used up.
std::optional<CellComplex> cell_complex(const Segmentation& segmentation,
                                        const Tolerances& tolerances, Work& work);

}  // namespace oriel
