#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel::test {

/// What of the CityJSON specification a file breaks, in sentences; empty if nothing. Checked are
/// required members, links between objects, vertex numbers, the shape and numbers of semantics and
/// materials, and the links between semantic surfaces. `header` is the first line of a CityJSONSeq
/// if `file` is one of its features, else null.
std::vector<std::string> structural_faults(const nlohmann::json& file,
                                           const nlohmann::json& header = nullptr);

}  // namespace oriel::test
