#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace oriel {

/// An allocator for vectors whose owner sets every element: resize() leaves new elements unset
/// instead of writing zeros that nobody reads.
template <class T>
struct UnsetAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  template <class U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }
};

/// A list of indices. resize() and the constructor of a size leave them unset.
using Numbers = std::vector<int, UnsetAllocator<int>>;

}  // namespace oriel
