#pragma once

#include "kernel/base/issue.h"
#include "kernel/base/work.h"
#include "model/solid.h"
#include "model/tolerances.h"
#include "model/vec3.h"

#include <functional>
#include <string>

namespace oriel {

/// How a building is turned into upright blocks with flat tops.
struct BlockOptions {
  /// False: one block over each piece of the footprint. True: a block for each part of the roof.
  bool is_by_roof = false;
  /// Two pieces of roof are one part if no more than this lies between them along the border that
  /// they share, seen from above. 3 m: a storey, as in 3DBAG's LoD 1.3.
  double step_m = 3;
  /// Parts with less area than this join the neighbour with the longest common border.
  double least_part_m2 = 4;
  /// Courtyards and separate pieces of the footprint with less area than this go; 0: none do.
  double least_piece_m2 = 0;
  /// Of one block: edges of the footprint that are shorter go, where they can
  /// (simplify_outlines); 0: none do.
  double least_edge_m = 0;
  /// True if no other building stands over the box of the plan: the footprint may come to cover
  /// more of it than it did. Null: nobody knows, and it only ever covers less.
  std::function<bool(const Box& gained)> may_cover{};
  /// True if another building stands against an edge of the plan: it stays as it is, so that no gap
  /// opens between the two. Null: none does.
  std::function<bool(Vec3 from, Vec3 to)> is_shared{};
  /// So much of a block's area, seen from above, has its roof below the block's top. 0.7 as in
  /// 3DBAG's `h_dak_70p`.
  double height_share = 0.7;
  /// A facet that looks down is ground if all of it lies no higher than this over the lowest point.
  double ground_reach_m = 0.5;
};

/// A building made of upright blocks.
struct Blocks {
  /// Closed; its facets look up, down, or sideways. One lump for each piece of the footprint.
  Solid solid;
  /// How many blocks there are.
  int parts = 0;
  /// The ground facets are less than half of what is seen from above (a building on stilts, or
  /// without a floor): what is seen from above was taken as the footprint.
  bool is_from_above = false;
  /// There was to be a block for each part of the roof, and they meet in a vertical edge without a
  /// common wall, which no closed solid can: one block was made.
  bool is_simplified = false;
  /// Edges of the footprint below BlockOptions::least_edge_m that had to stay.
  int short_edges = 0;
  /// The footprint has all its edges, since no closed solid came of a simpler one.
  bool keeps_footprint = false;
};

/// Blocks over the footprint of `solid`, from its lowest ground to the height that `options` say.
///
/// The footprint is the union of the ground facets, seen from above; its corners are the solid's
/// corners and the crossings of its edges, put together within weld_m, of a noisy building
/// (plane_offset_m above its default) within plane_offset_m. Nothing is simplified but what the
/// options say. No value and an error G406 if there is no footprint, if no closed solid comes of it
/// (outlines that touch in a point), if a top lies no higher than the ground, or if `work` is used
/// up. `name` is the building's in the message. Source: the levels of detail 1.0 to 1.3 of
/// Biljecki, Ledoux and Stoter 2016; docs/generalisation.md.
Checked<Blocks> blocks(const Solid& solid, const std::string& name, const BlockOptions& options,
                       const Tolerances& tolerances, Work& work);

}  // namespace oriel
