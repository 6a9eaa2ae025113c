#pragma once

#include "kernel/neighbours/neighbours.h"
#include "oriel/label.h"
#include "oriel/result.h"

#include <optional>
#include <span>

namespace oriel {

/// Fills the attributes of features that say how they stand to other buildings (party_wall,
/// exposed, faces_street, faces_yard), if these are known.
void describe_outlook_of_features(const Segmentation& segmentation, const LabelOptions& options,
                                  const std::optional<Neighbourhood>& around, FeatureTable& table);

/// The same of surfaces, for some rows of the table, whose azimuth and inclination are known.
void describe_outlook_of_surfaces(const Building& building, std::span<const int> rows,
                                  const LabelOptions& options,
                                  const std::optional<Neighbourhood>& around, SurfaceTable& table);

/// Adds to what is written of a building its neighbours, and to its walls how they stand to them,
/// if neighbours are known (docs/formats.md).
void add_outlook(const Building& building, const PipelineResult& result, LabelledBuilding& out);

}  // namespace oriel
