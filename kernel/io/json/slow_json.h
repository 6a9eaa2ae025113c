#pragma once

#include "kernel/io/json/text.h"

#include <optional>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel::detail {

/// The parsed text, for small files off the hot path. Nothing and an issue if it is not JSON: E102
/// empty, E103 not UTF-8, E104 not JSON, E105 truncated, E503 nested too deep, E504 a number out of
/// range, each with its place.
std::optional<nlohmann::json> parse_slowly(const TextName& name, std::string_view text,
                                           std::vector<Issue>& issues);

}  // namespace oriel::detail
