#pragma once

#include "generalise/context.h"
#include "generalise/generalised.h"
#include "kernel/base/issue.h"
#include "model/labelled_building.h"
#include "model/plan.h"

#include <map>
#include <string>
#include <vector>

namespace oriel {

/// The closing faces of a building's own solid, before anything is cut off.
std::vector<ClosingFace> closing_faces(const Solid& solid);

/// What was to go for its size only turns out to be a part of the building: without it something
/// that stays would hang in the air (G411), the building would reach out of its box (G412), or an
/// edge would be left that is too short (G418): a piece of a plinth that runs on. What
/// the plan names by its class is refused instead.
bool is_part(const RefusedStep& refused, const Plan& plan, const Interpretation& interpretation);

/// Carries out the plan of one building on its solid. Operations that cannot be carried out are
/// left out, each with a warning G401, or G405, G411, G412 or G418 if an invariant would break,
/// that names the feature and the reason; the others go on. Of a part (is_part), and of a feature
/// without a label that is a piece of another one, it is a note: such pieces come of how a concave
/// part was cut, and many have no cut of their own in the whole building. No value if nothing would
/// be left of the building (G402): it is to stay as it is.
///
/// Source: paper 5.1 (omission) and 5.2; docs/generalisation.md.
Checked<Generalised> generalise(const RedrawContext& context, const Plan& plan);

/// What is to be written of a generalised building, and which CityObjects have to leave the file.
struct Redrawn {
  LabelledBuilding labelled;
  std::vector<std::string> removed_ids;
  /// How many features of each label are gone; "": without a label.
  std::map<std::string, int> removed{};
};

/// Carries the labels of the input polygons over to the facets of the generalised solid. A facet
/// takes the semantic surface of the largest input polygon it is made of, of those that look the
/// same way if there are any; one that no input polygon lies in is a ClosureSurface if it is what
/// is left of a face that closed a hole, else it is named by its slope. Installations keep the
/// facets whose polygon is theirs, and get those without polygon that close the place of something
/// that was on or in them; those that were removed go, with their ids listed. Imprints that stay
/// are facets of their own, unless they are `undrawn`. The building gets flat counts
/// `oriel_removed_LABEL` and `oriel_removed_volume_m3`.
///
/// If nothing is gone and the building came as a solid it stays as it is: `labelled`, which is what
/// annotate says of it, so that generalising twice changes no byte of the geometry.
Redrawn redraw(const RedrawContext& context, Generalised generalised);

/// Adds to `redrawn` what is known of the features that are gone: how many of each label, and on
/// the building the flat attributes `oriel_removed_LABEL` and `oriel_removed_volume_m3`.
void count_removed(const std::vector<FeatureId>& removed, const Segmentation& segmentation,
                   const Interpretation& interpretation, Redrawn& redrawn);

/// What became of one feature, and why.
struct FeatureOutcome {
  std::string feature;    ///< its id
  std::string label;      ///< empty: unknown
  std::string operation;  ///< of the plan; empty: none was asked for
  std::string rule;       ///< the pack's entry or the profile's verdict that asked for it
  /// "kept": nothing was asked for, or nothing is to be done, or is_part(); "omitted"; "changed";
  /// "went along": with what it belongs to, its row, or what carries it; "refused": it is as it
  /// was.
  std::string outcome;
  /// Of a refusal, and of a part; G424 of what could not follow what it belongs to.
  Code code = Code::none;
  /// Of a refusal and a part; "pushed by ID", "moved with ID", "grew with ID", "went along with
  /// ID", and why it did not follow.
  std::string reason;
  /// Of a refusal, and of what could not follow: what would let the operator act, and the ids of
  /// what is in its way.
  std::vector<Need> needs{};
  std::vector<std::string> beside{};
};

/// The reason of a refusal, with what would let the operator act.
std::string reason_of(const RefusedStep& refused, const FeatureTable& table);

/// One for each feature, in their order.
std::vector<FeatureOutcome> feature_outcomes(const Plan& plan, const Generalised& generalised,
                                             const FeatureTable& table,
                                             const Interpretation& interpretation);

/// Figures of a solid.
struct SolidFigures {
  std::size_t facets = 0;
  std::size_t normals = 0;      ///< different directions of facets
  std::size_t short_edges = 0;  ///< shorter than the given length
  double volume_m3 = 0;
  double footprint_m2 = 0;
};

SolidFigures figures_of(const Solid& solid, double least_edge_m);

}  // namespace oriel
