#pragma once

#include "kernel/segment/boundary/boundary.h"
#include "model/solid.h"

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace oriel::detail {

/// Copies facets with their half-edges into a boundary of their own. Turned round, air becomes a
/// body. Only one copier at a time may be in use.
class FacetCopier {
 public:
  FacetCopier(const Boundary& from, bool is_turned)
      : from_(from), to_(from.world()), scratch_(from.world().scratch), is_turned_(is_turned) {}

  void add(std::span<const BodyFacetId> facets);

  /// Of a half-edge of the facets.
  [[nodiscard]] EdgeId copy_of(EdgeId e) const { return scratch_.copy_of.find(e); }
  Boundary& boundary() { return to_; }

 private:
  void add(BodyFacetId f);

  const Boundary& from_;
  Boundary to_;
  Scratch& scratch_;
  bool is_turned_;
  // Of the loop at hand.
  std::vector<PointId> origins_;
  std::vector<std::pair<EdgeId, EdgeId>> pairs_;  ///< copies of both sides of edges
};

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
Solid solid_of(std::span<const Boundary> bodies, const Solid& original, const std::set<int>& gone);

/// A fingerprint of the sides and areas of the facets, whatever their order: bodies of one
/// segmentation with the same are the same. 128 bits, so that long histories take little room.
using BodyState = std::array<std::uint64_t, 2>;
BodyState state_of(const Boundary& body);

/// What looks at a whole body costs what is dead in it, too: true where copying it pays.
bool is_mostly_dead(const Boundary& body);

/// `bend` is where to look first: a half-edge that was reflex when it was asked for last, if any.
bool is_convex(const Boundary& body, EdgeId& bend);

}  // namespace oriel::detail
