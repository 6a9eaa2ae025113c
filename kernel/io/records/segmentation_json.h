#pragma once

#include "kernel/model/building.h"
#include "kernel/model/cell_complex.h"
#include "kernel/model/description/feature_table.h"
#include "kernel/model/segmentation.h"

#include <string>

namespace oriel {

/// The segmentation of one building as one line of JSON with its line end, as `oriel segment
/// --json` prints it (docs/formats.md): frame, planes, cells, CSG tree, features by their
/// content-based ids in `table`, counts and issues. Planes are in the frame, boxes of features in
/// the input's coordinates. Trees may be of any depth. With a cell complex also its vertices (in
/// the frame, those that faces use), faces and contacts.
std::string segmentation_json(const Building& building, const Segmentation& segmentation,
                              const FeatureTable& table, const CellComplex* complex = nullptr);

}  // namespace oriel
