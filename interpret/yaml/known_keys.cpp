#include "interpret/yaml/known_keys.h"

#include "interpret/plan/operators.h"

#include <algorithm>
#include <array>

namespace oriel::rules {

namespace {

// clang-format off
constexpr auto kKnownKeys = std::to_array<std::string_view>({
    "abstract", "ambiguous_below", "as", "at_least", "because", "by", "class", "classes", "company",
    "decide", "do", "eaves-m", "emit", "evidence", "expect", "extends", "fall", "fixtures",
    "footprint-pct", "for", "function", "generalise", "given", "ground", "ground_reach", "groups",
    "hosts", "id", "invariants", "is", "iterate", "label", "macros", "min_score", "name", "of",
    "otherwise", "overhang-pct", "pack", "params", "party-walls-pct", "priority", "range",
    "relations", "remove", "require", "ridge-m", "rise", "roof", "rounds", "rules", "scale",
    "schema", "score", "surfaces", "tests", "tests_for", "top", "top-m", "type", "typical",
    "unless", "value", "version", "volume-pct", "wall", "weight", "when", "where", "why", "with",
    "within"});
// clang-format on
static_assert(std::ranges::is_sorted(kKnownKeys));

}  // namespace

bool is_known_yaml_key(std::string_view word) {
  if (std::ranges::find(kKnownKeys, word) != kKnownKeys.end()) return true;
  return std::ranges::any_of(operator_table(), [&](const OperatorKind& kind) {
    return (kind.name == word && !kind.arguments.empty()) || kind.takes(word);
  });
}

}  // namespace oriel::rules
