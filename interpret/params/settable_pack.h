#pragma once

#include "interpret/language/source.h"
#include "interpret/pack/pack.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel::rules {

struct SurfaceRules;

/// Why a pack would be refused with other values of its params.
struct RefusedValue {
  /// What the loader says of it, with the text that it speaks of.
  std::string sentence;
  /// Where that text stands in the pack.
  SourceSpan span;
  /// The params that it depends on, ascending.
  std::vector<std::size_t> params;
};

/// A copy of a pack whose params can be set to other values. Apart from its text, the pack is then
/// the same as if it had been loaded from a text with these values.
class SettablePack {
 public:
  explicit SettablePack(const Pack& pack);

  /// Sets the param, in metres, degrees or plain, and all that the loader computed from it: hosts,
  /// `decide:`, `typical:`. Whether the value is within its range is not looked at.
  void set(std::size_t param, double value);

  /// The first thing for which the loader would refuse the pack with the values that are set
  /// (R212): an empty range, hosts that overlap, shares beyond 0 .. 1, counts that exclude each
  /// other.
  [[nodiscard]] std::optional<RefusedValue> find_fault() const;

  [[nodiscard]] const Pack& pack() const { return pack_; }
  /// For those who change more of it for a while.
  [[nodiscard]] Pack& pack() { return pack_; }

 private:
  Pack pack_;
  /// Those of the pack; null if it has none.
  std::shared_ptr<SurfaceRules> surfaces_;
};

}  // namespace oriel::rules
