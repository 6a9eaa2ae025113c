#pragma once

#include "kernel/segment/boundary/boundary.h"

#include <array>
#include <cstdint>

namespace oriel::detail {

/// A fingerprint of the sides and areas of the facets, whatever their order: bodies of one
/// segmentation with the same are the same. 128 bits, so that long histories take little room.
using BodyState = std::array<std::uint64_t, 2>;
BodyState state_of(const Boundary& body);

/// What looks at a whole body costs what is dead in it, too: true where copying it pays.
bool is_mostly_dead(const Boundary& body);

/// `bend` is where to look first: a half-edge that was reflex when it was asked for last, if any.
bool is_convex(const Boundary& body, int& bend);

}  // namespace oriel::detail
