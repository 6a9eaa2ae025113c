#pragma once

#include "interpret/pack/pack.h"
#include "interpret/params/settable_pack.h"
#include "interpret/relabelling/variant.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace oriel::rules {

/// What a variant changes in a pack, by number.
struct PackChange {
  std::vector<std::pair<std::size_t, double>> params;
  std::vector<DroppedPart> without;
};

/// A copy of a pack that becomes one variant of it after the other. The pack must outlive it.
class ChangedPack {
 public:
  explicit ChangedPack(const Pack& base) : base_(&base), pack_(base) {}

  /// Undoes what was changed before; then changes that.
  void become(const PackChange& change);

  [[nodiscard]] const Pack& base() const { return *base_; }
  [[nodiscard]] const Pack& pack() const { return pack_.pack(); }
  [[nodiscard]] const PackChange& change() const { return change_; }
  /// SettablePack::find_fault().
  [[nodiscard]] std::optional<RefusedValue> find_fault() const { return pack_.find_fault(); }

 private:
  void undo();
  void drop(const DroppedPart& part);
  void drop_condition(const DroppedPart& part);

  const Pack* base_;
  SettablePack pack_;
  PackChange change_;
};

}  // namespace oriel::rules
