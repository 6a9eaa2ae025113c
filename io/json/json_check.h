#pragma once

#include "io/json/text.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel {

/// How deep a JSON text may be nested for sure; simdjson gives up at 1024.
constexpr std::size_t kMaxDepth = 1000;

/// What is wrong with a text that simdjson refused, found by a second, slow parse: E102 empty, E107
/// no JSON object, E103 not UTF-8, E503 nested too deep, E105 truncated, E104 not JSON, E504 a
/// number that no double or 64-bit integer holds. Always an error with its place; nothing if the
/// text is a JSON object after all.
std::optional<Issue> find_json_error(const TextName& name, std::string_view text);

/// The parsed text, for small files off the hot path. Nothing and an issue if it is not JSON: E102
/// empty, E103 not UTF-8, E104 not JSON, E105 truncated, E503 nested too deep, E504 a number out of
/// range, each with its place.
std::optional<nlohmann::json> parse_slowly(const TextName& name, std::string_view text,
                                           std::vector<Issue>& issues);

/// Reads a small file of JSON. Throws InputError E101 if it cannot be read, and what parse_slowly
/// finds.
nlohmann::json read_json_file(const std::string& path);

}  // namespace oriel
