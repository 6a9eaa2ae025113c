#pragma once

#include "kernel/segment/boundary/boundary.h"
#include "kernel/segment/cuts/lump.h"
#include "kernel/segment/sections/section.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// One edge of a cap as the rest has it: along the rim of the lump (the half-edge there), or free:
/// in the open, or inside the body, where two planes of the cut meet.
struct CapEdge {
  EdgeId rim = {};
  PointId from = {}, to = {};
};

/// A closed outline of a cap, counter-clockwise about the outward normal of the rest there.
struct CapLoop {
  std::vector<CapEdge> edges;
};

/// A cap: the new facet that closes the rest where a lump was.
struct CutCap {
  PlaneSide side = -1;
  std::vector<CapLoop> loops;
  /// Facets of the opposite side under the cap: they vanish into the body, and so does the cap over
  /// them.
  std::vector<BodyFacetId> covered;
  /// No new facet, but a part of an old one (of the ground, under a lump) that goes with the lump:
  /// the facet beyond the rim, whose side is the opposite of `side`.
  bool is_taken = false;
};

/// What a cut has made.
struct Carved {
  Boundary lump;
  /// A point inside the largest cap.
  Vec3 cap_point;
  /// Points of everything that has changed: an edge without any of them between its ends is as it
  /// was.
  std::vector<PointId> touched;
  /// Edges of the rest run along the caps' outlines: the caps are no mere pieces of the facets
  /// around them.
  bool has_rim_left = false;
};

/// What a pocket (cuts/pockets.h) leaves that is taken off without being made a body.
struct Filled {
  Vec3 cap_point;      ///< a point inside its cap
  double volume = 0;   ///< of the body it would have been
  double surface = 0;  ///< its area without the cap
};

/// Splits facets along the chords of the lump's regions, so that the lump is bounded by edges, and
/// returns its caps. Points that were made and the ends of edges that were split are added to
/// `touched`.
std::vector<CutCap> imprint(Boundary& body, const Section& section, const Lump& lump,
                            std::vector<PointId>& touched);

/// The same caps of a lump whose regions cover nothing and are bounded by edges alone, one for each
/// chord, as those of a window: nothing has to be split. Nothing of any other lump.
std::optional<std::vector<CutCap>> bare_caps(const Boundary& body, const Section& section,
                                             const Lump& lump);

/// The caps that take off what the rims leave, instead of the lump inside them. Nothing may be
/// covered.
std::vector<CutCap> turned_round(const Boundary& body, std::span<const CutCap> caps);

/// Takes the lump inside the rims of `caps` off the body. A protrusion goes with its surface; a
/// hole is filled: its walls leave the body, and the lump is the air that was there, turned right
/// side out. Caps close both, and facets of the rest are made maximal again. `mark` is left on the
/// largest cap of the rest.
///
/// Nothing, and the body is as it was, if the rims do not separate a lump, or if `accepts` is given
/// and says no to it.
using LumpCheck = std::function<bool(const Boundary& lump)>;
std::optional<Carved> take_off(Boundary& body, std::span<const CutCap> caps, bool is_hole,
                               FeatureId mark, std::vector<PointId> touched,
                               const LumpCheck& accepts = {});

/// Takes a pocket off the body as take_off() does, but makes no body of it. `facets`: those of the
/// pocket, ascending; `cap`: what closes the rest.
Filled fill_pocket(Boundary& body, const CutCap& cap, std::span<const BodyFacetId> facets,
                   bool is_hole, FeatureId mark);

}  // namespace oriel::detail
