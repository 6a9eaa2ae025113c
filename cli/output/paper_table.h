#pragma once

#include "oriel/paper_count.h"

#include <string>

namespace oriel::cli {

/// What `segment --count-as-paper` writes of a building, for a reader at a terminal: a table of the
/// first recursion, and one of all.
std::string paper_table(const std::string& building, const PaperCount& count);

/// The same as one JSON object on a line (docs/formats.md), with every recursion.
std::string paper_json(const std::string& building, const PaperCount& count);

}  // namespace oriel::cli
