#pragma once

#include "kernel/base/issue.h"
#include "model/building.h"
#include "model/cell_complex.h"
#include "model/description/feature_table.h"
#include "model/repair.h"
#include "model/segmentation.h"

#include <span>
#include <string>
#include <vector>

namespace oriel {

/// How a CSG tree is written: a list of nodes that name their children by number, or objects within
/// objects, which nest as deep as the tree (the form of version 0.1, for one more release).
enum class TreeForm { flat, nested };

/// Appends a CSG tree to the JSON object that is being written (docs/formats.md): members "root"
/// and "nodes", or the member "tree". An invalid root is null.
void append_tree(std::string& out, std::span<const CsgNode> nodes, NodeId root, TreeForm form);

/// The segmentation of one building as one line of JSON with its line end, as `oriel segment
/// --json` prints it (docs/formats.md): frame, planes, cells, CSG tree, features by their
/// content-based ids in `table`, counts and issues. Planes are in the frame, boxes of features in
/// the input's coordinates. Trees may be of any depth. With a cell complex also its vertices (in
/// the frame, those that faces use), faces and contacts.
std::string segmentation_json(const Building& building, const Segmentation& segmentation,
                              const FeatureTable& table, const CellComplex* complex = nullptr,
                              TreeForm form = TreeForm::flat);

/// What became of one building as a line of JSON, with its line end (docs/formats.md, "Repair
/// report"). Places are in the input's coordinates, polygons numbers in reading order from 0.
/// `is_solid`: a solid could be made. `issues` are those of solidify.
std::string repair_json(const Building& building, bool is_solid, const RepairReport& report,
                        const std::vector<Issue>& issues);

}  // namespace oriel
