#pragma once

#include "generalise/operators/operator.h"

namespace oriel {

/// The operator `typify`: many openings of a row become fewer and larger ones (paper 5.1,
/// "typification").
///
/// `{typify: {ratio: NUMBER, gap: LENGTH}}`. Of n openings m = n · ratio stay, rounded and at least
/// one. Each has the mean width and height of the n, times √(n / m): the area and the aspect stay.
/// They stand at equal distances from the first to the last edge of the row, at the mean height of
/// its middle. The first m of the row stand for them; the others are gone. Precondition: at least
/// two recesses that are boxes, of one class, storey and facet, and m < n. Touches: the wall's
/// facet. Inverse: omit, and the recesses that the segmentation still has.
detail::Placed typify(const Redrawing& task);

/// How many of n stay.
std::size_t typified_count(std::size_t n, double ratio);

}  // namespace oriel
