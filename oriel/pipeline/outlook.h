#pragma once

#include "kernel/neighbours/neighbours.h"
#include "oriel/label.h"
#include "oriel/result.h"

#include <span>

namespace oriel {

/// Looks around a building, if neighbours are known: fills result.surroundings, with what is wrong
/// there among the issues.
void look_around(const Building& building, const LabelOptions& options, PipelineResult& result);

/// Fills the attributes of features that say how they stand to other buildings (party_wall,
/// exposed, faces_street, faces_yard), if neighbours are known. The features are described.
void describe_outlook_of_features(const Segmentation& segmentation, const LabelOptions& options,
                                  PipelineResult& result);

/// The same of surfaces, for some rows of the table, whose azimuth and inclination are known.
void describe_outlook_of_surfaces(const Building& building, std::span<const int> rows,
                                  const LabelOptions& options, const PipelineResult& result,
                                  SurfaceTable& table);

/// Adds to what is written of a building its neighbours, and to its walls how they stand to them,
/// if neighbours are known (docs/formats.md).
void add_outlook(const Building& building, const PipelineResult& result, LabelledBuilding& out);

}  // namespace oriel
