#pragma once

#include "kernel/model/segmentation.h"

#include <string>

namespace oriel::cli {

/// What `segment --tree` writes of a building: its CSG tree as it was cut, balanced and with
/// touching parts merged, each with its figures, and whether all are one body. A line of text, or
/// of JSON (docs/formats.md). `is_same` says if they are.
std::string tree_report(const std::string& building, const Segmentation& segmentation, bool is_json,
                        bool& is_same);

}  // namespace oriel::cli
