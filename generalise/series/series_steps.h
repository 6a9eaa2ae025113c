#pragma once

#include "generalise/series/change.h"
#include "kernel/model/plan.h"
#include "kernel/model/segmentation.h"

#include <cstddef>
#include <set>
#include <vector>

namespace oriel {

/// What one operation of a series does.
struct SeriesStep {
  Step step;  ///< what the operation is named by: the first one
  double scale = 0;
  bool is_redrawing = false;
  std::vector<Step> steps;        ///< to be carried out for it
  std::set<FeatureId> gone{};     ///< features that are gone with it
  std::vector<FeatureId> with{};  ///< other features that it is about
  Change change{};                ///< found last
};

/// Steps (indices, ascending) that no part of a change tells apart, and what they do together.
struct SeriesGroup {
  std::vector<std::size_t> steps;
  Change change;
};

/// Gives the parts of a change (parts_of) to the steps whose polygons they have; steps that meet in
/// a part are one group. Every step is in one group; groups come in the order of their last steps.
/// A part without polygons goes to the step whose feature's box is nearest. `origin_m` is that of
/// the segmentation's frame.
std::vector<SeriesGroup> groups_of(const std::vector<SeriesStep>& steps, const Change& change,
                                   const Segmentation& segmentation, Vec3 origin_m);

/// The change moves the outer ring of a facet where the step's feature, or one that goes with it,
/// reaches it: a door at the foot of its wall. Without such steps the ring stays, and what others
/// on the facet do to its holes can be told apart.
bool is_on_rim(const SeriesStep& step, const Change& change, const Segmentation& segmentation,
               Vec3 origin_m);

}  // namespace oriel
