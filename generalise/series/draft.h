#pragma once

#include "generalise/change.h"
#include "kernel/model/plan.h"
#include "kernel/model/segmentation.h"

#include <cstddef>
#include <set>
#include <vector>

namespace oriel::detail {

/// What one operation of a series does.
struct Draft {
  Step step;
  double scale = 0;
  bool is_redrawing = false;
  std::vector<Step> steps;        ///< to be carried out for it
  std::set<FeatureId> gone{};     ///< features that are gone with it
  std::vector<FeatureId> with{};  ///< other features that it is about
  Change change{};                ///< found last
};

/// Drafts (indices, ascending) that no part of a change tells apart, and what they do together.
struct DraftShare {
  std::vector<std::size_t> drafts;
  Change change;
};

/// Gives the parts of a change (parts_of) to the drafts whose polygons they have; those that meet
/// in a part share it. Every draft is in one share; shares come in the order of their last drafts.
/// A part without polygons goes to the draft whose feature's box is nearest. `origin_m` is that of
/// the segmentation's frame.
std::vector<DraftShare> shares_of(const std::vector<Draft>& drafts, const Change& change,
                                  const Segmentation& segmentation, Vec3 origin_m);

/// The change moves the outer ring of a facet where the draft's feature, or one that goes with it,
/// reaches it: a door at the foot of its wall. Without such drafts the ring stays, and what others
/// on the facet do to its holes can be told apart.
bool is_on_rim(const Draft& draft, const Change& change, const Segmentation& segmentation,
               Vec3 origin_m);

}  // namespace oriel::detail
