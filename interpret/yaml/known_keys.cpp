#include "interpret/yaml/known_keys.h"

#include <algorithm>
#include <array>

namespace oriel::rules {

namespace {

// clang-format off
constexpr std::array<std::string_view, 82> kKnownKeys = {
    "abstract", "aggregate", "ambiguous_below", "anchor", "as", "at_least", "because", "by", "class",
    "classes", "company", "decide", "displace", "do", "eaves-m", "emit", "enlarge", "evidence",
    "expect", "extends", "fall", "fixtures", "footprint-pct", "for", "function", "gap",
    "generalise", "given", "ground", "ground_reach", "groups", "hosts", "id", "into", "invariants",
    "is", "iterate", "label", "macros", "min_score", "name", "of", "otherwise", "overhang-pct",
    "pack", "params", "party-walls-pct", "priority", "range", "ratio", "relations", "remove",
    "require", "ridge-m", "rise", "roof", "rounds", "rules", "scale", "schema", "score",
    "surfaces", "symbolise", "tests", "tests_for", "to", "top", "top-m", "type", "typical",
    "typify", "unless", "value", "version", "volume-pct", "wall", "weight", "when", "where", "why",
    "with", "within"};
// clang-format on
static_assert(std::ranges::is_sorted(kKnownKeys));

}  // namespace

bool is_known_yaml_key(std::string_view word) {
  return std::ranges::find(kKnownKeys, word) != kKnownKeys.end();
}

}  // namespace oriel::rules
