#pragma once

#include "interpret/explain/explain.h"
#include "interpret/explain/feature_relations.h"  // IWYU pragma: export
#include "interpret/pack/rule_base.h"
#include "kernel/base/ids.h"
#include "model/building.h"
#include "model/description/feature_names.h"  // IWYU pragma: export
#include "model/interpretation.h"
#include "model/segmentation.h"
#include "oriel/result.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// In all of these `result` is what label() said of `building` with the same rules, and is_done()
/// or, for surfaces, has_surfaces() (with LabelOptions::measures_surfaces). to_text() and to_json()
/// in interpret/explain/explain.h write an Explanation.

/// By feature: a name that a person would use, "window 3 of facade south, storey 2"
/// (model/description/feature_names.h). Labels are those of `result`.
std::vector<std::string> names_of_features(const PipelineResult& result);

/// The feature with the id `text`, else those whose id begins with it; if there is none, that with
/// this name or those whose names begin with it. In their order.
std::vector<FeatureId> find_features(const PipelineResult& result, std::string_view text);

/// Why a feature has its label, or none: every rule with its conditions, what was found and what
/// was asked for, and which number of the pack would change it (docs/rules.md). Of a corrected
/// label who corrected it and why, and what the rules say.
Explanation explain(const PipelineResult& result, const RuleBase& rules, FeatureId feature);

/// The same of every feature, in their order, in less time than one by one; what would change a
/// label is not searched for.
std::vector<Explanation> explain_features(const PipelineResult& result, const RuleBase& rules);

/// What a surface is, "WallSurface", and the lines of explain_surface() that say why.
struct SurfaceExplanation {
  std::string type;
  std::string reason;
};

/// One for each polygon, in the order of Building::polygons; none if there are no surfaces.
std::vector<SurfaceExplanation> explain_surfaces(const Building& building,
                                                 const PipelineResult& result,
                                                 const RuleBase& rules);

/// What a surface is and why: "house: polygon 7 is WallSurface by …", its attributes and
/// conditions. `polygon` is an index into Building::polygons.
std::string explain_surface(const Building& building, const PipelineResult& result,
                            const RuleBase& rules, std::size_t polygon);

/// A polygon near a point.
struct PolygonAt {
  /// Index into Building::polygons.
  std::size_t polygon = 0;
  double distance_m = 0;
};

/// The polygon that a point (in the input's coordinates) lies on: of those it is inside of, seen
/// along their normal, the one whose plane is nearest, of equal ones the first. Nothing if none is
/// nearer than a pick on a screen is off (5 cm).
std::optional<PolygonAt> polygon_at(const Building& building, Vec3 point);

/// The smallest feature with a label that the polygon lies in, else the smallest; invalid: none.
FeatureId feature_of(const Building& building, const PipelineResult& result, std::size_t polygon);

/// Returns what a feature is to the building, in a word: "protrusion", "hole", "cavity", and
/// "panel" of an imprint, a flat outline.
std::string_view kind_word(Sense sense);

/// Describes a feature in one plain sentence, from its attributes: "window: a 1.1 × 1.4 m hole in a
/// wall, 0.9 m above the ground, one of a row of four". What is not known is left out. `result` is
/// of the building's segmentation, `interpretation` what a pack said of it.
std::string plain_sentence(const PipelineResult& result, const Interpretation& interpretation,
                           FeatureId feature);

/// Finds where storeys begin, in metres over the origin of the building's frame, from below: the
/// foot of the building, then half-way between the openings of a storey and those of the next one.
/// Empty for a building that has no openings in storeys, or was not segmented. Only cuts through a
/// picture are made by it.
std::vector<double> storey_floors(const Building& building, const PipelineResult& result);

}  // namespace oriel
