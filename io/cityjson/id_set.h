#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace oriel {

/// The ids that a stream had so far, in 16 bytes each, at a load of at most one half. Ids are known
/// by a hash of 128 bits: among 10^9 of them two share one with a probability of 10^-21.
class IdSet {
 public:
  /// False if the id was there.
  bool insert(std::string_view id);

 private:
  using Key = std::array<std::uint64_t, 2>;  ///< {0, 0}: a free slot
  [[nodiscard]] std::size_t slot_of(const Key& key) const;
  void grow();

  std::vector<Key> slots_;
  std::size_t count_ = 0;
};

}  // namespace oriel
