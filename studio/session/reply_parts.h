#pragma once

#include "oriel/explain.h"
#include "studio/session/labels/labelled_buildings.h"
#include "studio/session/request_body.h"
#include "studio/session/standing.h"

#include <cstddef>
#include <string>
#include <vector>

namespace oriel::studio {

/// What replies say of one building, however it was read: a session and a Recording give the same.

/// A building with its number.
struct NumberedBuilding {
  std::size_t number = 0;
  const OpenBuilding* open = nullptr;
  /// The place that is the origin of its numbers.
  Vec3 origin_m;
};

/// What a picture needs of buildings, as bytes that a browser reads without looking at every
/// number. First four bytes: the length of a JSON text; then the text, blanks up to the next
/// multiple of four, and for each building that the text names, in its order, these lists, each
/// filled up to a multiple of four. Numbers are whole, the lowest byte first.
///
/// | list | numbers |
/// |---|---|
/// | vertices | three each, in millimetres from `base_mm`; 4 bytes, or 2 if `is_short` |
/// | ring_ends | for each polygon the end of its rings in corner_ends |
/// | corner_ends | for each ring, an outer one before its holes, the end of its corners |
/// | corners | vertices |
/// | owner_ends | for each polygon the end of its owners |
/// | owners | features that list the polygon, the smallest first |
///
/// The lists but the first have 2 bytes a number if `are_few`, else 4.
///
/// The JSON text: {"buildings": [{number, base_mm, is_short, are_few, vertices, polygons, rings,
/// corners, owners (how many of each), storeys_mm}]}; millimetres from the origin of each.
std::string building_bytes(const std::vector<NumberedBuilding>& buildings);

/// Gives a building of the verb `state`; `open` is null while it is not loaded.
StudioJson building_entry(const BuildingOfFile& read, const OpenBuilding* open,
                          const Standing& standing);

/// Gives the features of a building for `features`; without `interpretation` names have no labels.
StudioJson features_json(const OpenBuilding& open, const Interpretation* interpretation);

StudioJson surfaces_json(const std::vector<SurfaceExplanation>& surfaces);

/// Gives the answer to `explain`, whose `correction` is null.
StudioJson explanation_json(const RuleBase& rules, const LabelledFeatures& labelled,
                            const Explanation& explanation, FeatureId feature);

}  // namespace oriel::studio
