#pragma once

#include <cstddef>

#include <boost/dynamic_bitset.hpp>

namespace oriel::detail {

/// A set of some of a fixed number of slots.
class SlotSet {
 public:
  explicit SlotSet(std::size_t slots) : bits_(slots) {}

  void insert(std::size_t slot) { bits_.set(slot); }
  void erase(std::size_t slot) { bits_.reset(slot); }

  /// Calls `visit(slot)` for those from `first` up to `last`, ascending; `visit` may take its slot
  /// out.
  template <class Visit>
  void for_each(std::size_t first, std::size_t last, Visit visit) const {
    for (std::size_t i = first == 0 ? bits_.find_first() : bits_.find_next(first - 1); i < last;
         i = bits_.find_next(i))
      visit(i);
  }
  template <class Visit>
  void for_each(Visit visit) const {
    for_each(0, bits_.size(), visit);
  }

 private:
  boost::dynamic_bitset<> bits_;
};

}  // namespace oriel::detail
