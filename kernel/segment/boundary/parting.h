#pragma once

#include "kernel/model/solid.h"
#include "kernel/segment/boundary/boundary.h"

#include <set>
#include <vector>

namespace oriel::detail {

/// True if all facets hang together: no cavity, and no cut has parted the body.
bool is_connected(const Boundary& body);

/// The body without its dead half-edges and facets, which are numbered anew, in their order.
Boundary compacted(const Boundary& body);

/// The connected pieces of a body, each with its cavities, in the order of their first facets.
std::vector<Boundary> part_into_lumps(const Boundary& body);

/// The cavities of a body as bodies of their own, turned right side out; `body` loses them. Usually
/// none.
std::vector<Boundary> take_out_cavities(Boundary& body);

/// Fills the cavity that has this box; false if the body has none.
bool fill_cavity(Boundary& body, const Box& box);

/// The bodies as one solid, with the planes of `original`. Facets list the input polygons of the
/// facets of `original` they are made of, but for those in `gone`.
Solid solid_of(const std::vector<Boundary>& bodies, const Solid& original,
               const std::set<int>& gone);

}  // namespace oriel::detail
