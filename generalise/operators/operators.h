#pragma once

#include "generalise/invariants/invariants.h"
#include "generalise/operators/host.h"
#include "kernel/segment/remove.h"
#include "model/plan.h"
#include "model/segmentation.h"
#include "model/solid.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The operators that a pack can ask for. Each is one function; the table in operators.cpp says what
// carrying out a plan has to know of it. To add one: a function here and in rows.cpp or single.cpp,
// a row in the table, its arguments in interpret/plan/operators.cpp, a test in
// tests/generalise/operators, a section in docs/generalisation.md.

namespace oriel {

/// What an operator that redraws features works on: the solid from which they were taken off
/// already, and the steps for them, which have one rule and so the same arguments. Groups
/// (aggregate, typify) have all members, ordered along their wall; those of which some may stay
/// (Operator::takes_some) have all of one wall plane; other operators have one step.
struct Redrawing {
  const Solid& solid;
  const Segmentation& segmentation;
  std::vector<Step> steps;
  double scale = 0;
  /// Of a refusal it is to be told what would let the operator act (Placed::LeftMember::hindrance).
  bool tells_needs = false;

  [[nodiscard]] const Feature& feature(std::size_t member = 0) const {
    return segmentation.features[steps[member].feature.index()];
  }
  /// An argument in metres or a ratio; `fallback` if the pack does not say.
  [[nodiscard]] double number(const char* name, double fallback) const {
    const auto found = steps[0].numbers.find(name);
    return found == steps[0].numbers.end() ? fallback : found->second;
  }
  [[nodiscard]] std::string word(const char* name, const char* fallback) const {
    const auto found = steps[0].words.find(name);
    return found == steps[0].words.end() ? fallback : found->second;
  }
  /// The least distance to what is beside, unless the pack says `gap`.
  [[nodiscard]] double gap_m() const { return number("gap", kGapOnMap_m * scale); }
  /// The least size, unless the pack says `to`.
  [[nodiscard]] double to_m() const { return number("to", kToOnMap_m * scale); }
  /// The host of a member on the solid as it is; what stood on something that belongs to it, such
  /// as its frame, is on what that stood on.
  [[nodiscard]] std::optional<detail::Host> host(std::size_t member = 0) const;
};

/// The operator `omit`: features leave the building (paper 5.1, "omission").
///
/// Precondition: the feature's cut can be made again on the solid, and takes no feature along that
/// is to stay; of a building no part of more than half its volume goes: which of two parts is the
/// feature and which the rest is up to the segmentation (under a roof that juts out all around, the
/// walls are a feature of the roof). Touches: the cells of the feature and of all that sits on it;
/// of the rest, the facets of its split planes. Inverse: the solid before, which the caller still
/// has; the removed cells stand in the segmentation. A feature that cannot be omitted is refused
/// with its reason and stays whole. With a validator, features without a cut of their own go as
/// cells (remove_cells).
Remainder omit(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
               const SegmentOptions& options, const SolidValidator& validator = {});

/// Makes a feature part of its host: its shape stays, but its facets are named by their slope, and
/// it is no object of its own any more. `task.solid` is the solid with the feature still on it.
///
/// Refused if no facet is made of the feature's polygons alone.
detail::Placed merge(const Redrawing& task);

/// The operator `enlarge`: a feature becomes as large as can be seen (paper 5.1, "enlargement"): an
/// opening, or a slab that is too thin.
///
/// `{enlarge: {to: LENGTH, anchor: sill|centre, gap: LENGTH}}`: width and height become at least
/// `to`; the sill stays where it is, or the centre does. Where host margin or neighbours leave no
/// room for all of it, it grows as far as eighths of the way allow, else in one direction only.
/// Precondition: a recess in a wall, a block that is a box, or an outline (box_depth), on a facet
/// that is found again; some growth is possible. Touches: the wall's facet, and that of the ground
/// or slab that it stands on. Depth, directions and the parallel pane stay.
/// Inverse: omit, and the outline that the segmentation still has, sunk in or put on.
detail::Placed enlarge(const Redrawing& task);

/// The operator `symbolise`: a template takes the place of a feature, fitted to its size (paper
/// 5.1, "symbolisation").
///
/// `{symbolise: {with: TEMPLATE, to: LENGTH, gap: LENGTH}}`; sides are at least `to` long.
///  - chimney_block: an upright block on the roof with a flat top at the feature's top, its base
///    around the middle of the feature;
///  - dormer_box: a box with an upright front where the feature's was and a flat top at its top,
///    which runs back into the roof;
///  - balcony_box: a slab at the wall at the feature's bottom, as wide and as deep as it, with its
///    volume.
/// Precondition: a protrusion whose roof or wall is found again; there is room for the template on
/// that facet or, on a roof, across its edges. A chimney block that does not fit in its place moves
/// by no more than half of its sides. Touches: the facets under it. New directions: up; others only
/// if no wall looks within 45 degrees of where the eaves run or the roof falls: these. Inverse:
/// omit, and the feature's cells, which the segmentation still has.
detail::Placed symbolise(const Redrawing& task);

/// The operator `collapse`: a recess, or what sticks out, loses its depth and leaves
/// its outline on its wall or roof as an imprint (paper 5.1; design, "collapse to imprint").
///
/// Precondition: its facet is found again and the outline, the rectangle around it in that facet,
/// lies inside. Touches: that facet, which is split along the outline. Inverse: omit, and the
/// feature's cells, which the segmentation still has.
detail::Placed collapse(const Redrawing& task);

/// The operator `flatten`: what is thin and lies flat on its wall or roof goes into it (paper 5.1,
/// Figure 7: a lamina, and a cap that reaches beyond what it lies on).
///
/// What juts out beyond its facet is trimmed. If the rest covers more than half of the facet, the
/// facet takes its place: it moves outwards (of a recess inwards) by the feature's volume over its
/// own area, so that upright on its neighbours the volume is kept. The feature is gone in either
/// case. Precondition: it has depth; if its facet, which may have gone, is to move: it was split
/// off by one plane, no outline that stays is on the facet, and it can move (move_facet). Touches:
/// the facet and those around it. Inverse: the facet moves back, and the feature's cells, which the
/// segmentation still has.
detail::Placed flatten(const Redrawing& task);

/// True of `{aggregate: {into: block}}`, which is for single features.
bool becomes_block(const Step& step);

/// The operator `aggregate`: the openings of one storey on one facade become a strip (paper 5.1,
/// "aggregation").
///
/// `{aggregate: {into: block}}` is for a slab with its parapet: the box around the feature and all
/// that sits on it takes their place. `{aggregate: {into: strip, gap: LENGTH}}`: the strip is of
/// the kind of most of them (recess, block or outline), as wide as all of them together from the
/// first to the last, with the area of all of them (so it is lower), about the middle of their
/// heights, and with their mean depth. It stands for the first of them along the wall; the others
/// are gone. Where something divides the row there is a strip on either side of it, and what is
/// alone between others stays as it is. Precondition: at least two, of one class, storey and wall
/// plane, each a recess in a wall, a block that is a box, or an outline. Touches: the wall's facet.
/// Inverse: omit, and the recesses that the segmentation still has.
detail::Placed aggregate(const Redrawing& task);

/// The operator `typify`: many openings of a row become fewer and larger ones (paper 5.1,
/// "typification").
///
/// `{typify: {ratio: NUMBER, gap: LENGTH}}`. Of n openings m = n · ratio stay, rounded and at least
/// one. Each has the mean width and height of the n, times √(n / m): the area and the aspect stay.
/// They stand at equal distances from the first to the last edge of the row, at the mean height of
/// its middle. The first m of the row stand for them; the others are gone. Where something stands
/// in the way, m of the row stay at their own places, the ends among them, and grow as far as there
/// is room. Precondition: at least two, as for aggregate, and m < n. Touches: the wall's facet.
/// Inverse: omit, and the recesses that the segmentation still has.
detail::Placed typify(const Redrawing& task);

/// How many of n stay.
std::size_t typified_count(std::size_t n, double ratio);

/// The operator `displace`: the openings of a facade move apart (paper 5.1, "displacement").
///
/// `{displace: {to: LENGTH, gap: LENGTH}}`: those of one wall plane, recessed, flush or proud, move
/// until `gap` lies between them, and between them and what else is on the wall and its ends; with
/// `to` they grow first, about their centres, to at least that width. Their order is kept, rows
/// stay rows, and the sum of the squared shifts is the least there is (FacadeRoom::arrange). Sizes
/// and depths stay. Takes some (Operator::takes_some): an opening that need not move stays as it
/// is, as do those that have no room, which the others then keep off. Precondition: what moves is a
/// recess, a block that is a box, or an outline. Touches: the wall's facet. Inverse: omit, and the
/// openings that the segmentation still has.
detail::Placed displace(const Redrawing& task);

/// What carrying out a plan has to know of an operator.
struct Operator {
  std::string_view name;
  /// Draws what takes the place of the features; null: they only leave (omit).
  detail::Placed (*redraw)(const Redrawing&);
  /// Tasks of a lower rank are carried out first: what moves a facet comes after what is put onto
  /// it, outlines come last.
  int rank;
  /// It redraws several features together, if their steps ask for it.
  bool (*is_for_groups)(const Step&);
  /// How many of the features of a task are still there afterwards; the first ones, unless the
  /// operator says which (Placed::stays).
  std::size_t (*kept)(const std::vector<Step>&);
  /// Its tasks are all features of one wall plane, of which some may stay as they are.
  bool takes_some = false;
};

/// Throws std::out_of_range if there is none: loading a pack checks the names.
const Operator& operator_named(std::string_view name);

}  // namespace oriel
