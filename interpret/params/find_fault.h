#pragma once

#include "interpret/evaluate/pack_values.h"
#include "interpret/language/source.h"
#include "interpret/pack/pack.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace oriel::rules {

/// Why a pack would be refused with other values of its params.
struct RefusedValue {
  /// What the loader says of it, with the text that it speaks of.
  std::string sentence;
  /// Where that text stands in the pack.
  SourceSpan span;
  /// The params that it depends on, ascending.
  std::vector<std::size_t> params;
};

/// The first thing for which the loader would refuse a pack that states these values (R212): an
/// empty range, hosts that overlap, shares beyond 0 .. 1, counts that exclude each other. Whether
/// values are within their ranges is not looked at.
std::optional<RefusedValue> find_fault(const Pack& pack, const PackValues& values);

}  // namespace oriel::rules
