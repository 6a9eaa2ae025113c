#pragma once

#include "generalise/generalise.h"
#include "kernel/base/issue.h"
#include "model/building.h"
#include "model/description/feature_table.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// An edge of a solid that is shorter than asked for.
struct ShortEdge {
  Vec3 from, to;
  double length_m = 0;
  /// The smallest feature whose box holds it; invalid: the body.
  FeatureId feature;

  friend bool operator==(const ShortEdge&, const ShortEdge&) = default;
};

/// Two parallel facets that look at each other from nearer than asked for, with air between them.
struct NarrowGap {
  Vec3 at;  ///< in one of the facets
  double width_m = 0;
  FeatureId feature;  ///< as of ShortEdge
};

/// Vertices that cuts made lie off the box of their feature by rounding only; the grid of a solid
/// is finer than a hundredth of it.
inline constexpr double kOnBox_m = 1e-3;

/// Edges shorter than `least_m`, each once, in the order of facets. Features that are `removed`
/// (ascending) have none.
std::vector<ShortEdge> short_edges(const Solid& solid, const Segmentation& segmentation,
                                   const std::vector<FeatureId>& removed, double least_m);

/// Those of `after` that are new: without edges from a corner of the context's solid to another
/// one, which stand for shorter ones that were between them, and without those along the depth of a
/// recess.
std::vector<ShortEdge> new_short_edges(const RedrawContext& context, const Solid& after,
                                       const std::vector<FeatureId>& removed, double least_m);

/// Those of parts that an operator drew: new edges of facets whose input polygons are all of
/// features that are changed or removed, one of a changed one at least, the owner. Without those
/// along the depth of a recess, and those as long as their feature was along them: of a block that
/// is as deep as it was, of a low window that moved.
std::vector<ShortEdge> short_edges_of_drawn(const RedrawContext& context, const Generalised& drawn,
                                            double least_m);

/// The edges without those of parts that stay as they were: edges of a cell, or of an outline, of
/// the body or of a feature that is neither changed nor removed. A ridge that
/// a chimney hid is such an edge. `least_m` is what they are shorter than.
std::vector<ShortEdge> without_whole_edges(std::vector<ShortEdge> edges,
                                           const Segmentation& segmentation,
                                           const Generalised& drawn, double least_m);

/// Gaps narrower than `least_m` between parallel facets that overlap, seen along their normal.
std::vector<NarrowGap> narrow_gaps(const Solid& solid, const Segmentation& segmentation,
                                   const std::vector<FeatureId>& removed, double least_m);

/// Adds to the plan that features go whose edges are too short, everywhere: of what the plan left,
/// `generalised`, the owner of each short edge, or, if that was to go and was refused, what carries
/// it. Only features with a middle extent b below `most_b_m` go so. The steps have the rule `rule`.
/// False if there are none: then the plan stays as it is.
bool add_fine_owners(const RedrawContext& context, const Generalised& generalised, double least_m,
                     double most_b_m, const std::string& rule, Plan& plan);

/// What a target asks for: a least length of edges, of those that are new or, `is_everywhere`, of
/// all, and of gaps.
struct Fineness {
  double least_m = 0;
  bool is_everywhere = false;
  /// Why new edges stay that nobody tried to clear; empty: there are none.
  std::string why_not_tried{};
};

/// What of a building that was redrawn as `after` is finer: for each feature with such edges a
/// G415, and everywhere for each with such gaps a G416, warnings. It says if the feature was to
/// change and was refused. Of new edges (new_short_edges) it says why they could not be cleared.
/// Notes are those of features that were refused, which is reported already, those that nobody
/// tried to clear (blocks) and, apart from others, those of parts that stay as they were
/// (without_whole_edges).
std::vector<Issue> fineness_issues(const RedrawContext& context, const Solid& after,
                                   const Generalised& generalised, const Fineness& asked);

}  // namespace oriel
