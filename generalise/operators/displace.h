#pragma once

#include "generalise/operators/operator.h"

#include <vector>

namespace oriel {

/// Moves the recesses of a row along their wall until `gap` lies between them and to the ends of
/// the wall; with `to` they grow first, about their centres, to at least that width. Their order is
/// kept, and the sum of the squares of the shifts is the smallest there is. Heights and depths
/// stay.
///
/// Refused if the row needs no change or more room than the wall has, if a member is no box sunk
/// into the wall, or if one would come nearer than `gap` to another part.
detail::Placed displace(const Redrawing& task);

/// Positions next to the wished-for ones (ascending) that are no nearer to each other than
/// `apart[i]` (of i and i + 1) and lie in [low, high]: the ones with the least sum of squared
/// shifts, by pooling adjacent violators (Barlow et al. 1972). There must be room for them.
std::vector<double> least_shifts(const std::vector<double>& wished,
                                 const std::vector<double>& apart, double low, double high);

}  // namespace oriel
