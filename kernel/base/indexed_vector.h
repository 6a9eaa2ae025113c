#pragma once

#include "kernel/base/assert.h"
#include "kernel/base/ids.h"
#include "kernel/base/index.h"

#include <cstddef>
#include <initializer_list>
#include <ranges>
#include <span>
#include <utility>
#include <vector>

namespace oriel {

/// An edge of a mesh or graph.
using EdgeId = Id<struct EdgeTag>;
/// A loop of a face or facet, where all loops stand in one list.
using LoopId = Id<struct LoopTag>;
/// A point or vertex of a list of points.
using PointId = Id<struct PointTag>;
/// A place in an order of candidates or steps: the smaller comes first.
using Rank = Id<struct RankTag>;

/// The ids from `first` to before `past`, ascending, to be iterated over.
template <class IdType>
auto ids_between(IdType first, IdType past) {
  return std::views::iota(first.value, past.value) |
         std::views::transform([](int i) { return IdType{i}; });
}
/// The ids 0 … count − 1.
template <class IdType>
auto ids_below(std::size_t count) {
  return ids_between(IdType{0}, IdType{static_cast<int>(count)});
}

/// A std::vector that is addressed by ids of one kind only: element `k` is that of the id `k`. An
/// id that is invalid or beyond the end is a fault of the caller, which ORIEL_ASSERT reports.
template <class IdType, class T>
class IndexedVector {
 public:
  using value_type = T;
  using iterator = typename std::vector<T>::iterator;
  using const_iterator = typename std::vector<T>::const_iterator;
  using reference = typename std::vector<T>::reference;
  using const_reference = typename std::vector<T>::const_reference;

  IndexedVector() = default;
  explicit IndexedVector(std::size_t size) : items_(size) {}
  IndexedVector(std::size_t size, const T& value) : items_(size, value) {}
  IndexedVector(std::initializer_list<T> items) : items_(items) {}
  explicit IndexedVector(std::vector<T> items) : items_(std::move(items)) {}

  [[nodiscard]] reference operator[](IdType id) {
    ORIEL_ASSERT(contains(id), "the id is not one of the list");
    return items_[id.index()];
  }
  [[nodiscard]] const_reference operator[](IdType id) const {
    ORIEL_ASSERT(contains(id), "the id is not one of the list");
    return items_[id.index()];
  }

  [[nodiscard]] bool contains(IdType id) const { return id.is_valid() && id.index() < size(); }
  [[nodiscard]] std::size_t size() const { return items_.size(); }
  [[nodiscard]] bool empty() const { return items_.empty(); }
  /// All ids, ascending.
  [[nodiscard]] auto ids() const { return ids_below<IdType>(size()); }
  /// The id that the next push_back() returns.
  [[nodiscard]] IdType next_id() const { return IdType{static_cast<int>(size())}; }

  IdType push_back(T item) {
    items_.push_back(std::move(item));
    return IdType{static_cast<int>(size()) - 1};
  }
  template <class... Arguments>
  IdType emplace_back(Arguments&&... arguments) {
    items_.emplace_back(std::forward<Arguments>(arguments)...);
    return IdType{static_cast<int>(size()) - 1};
  }
  void reserve(std::size_t size) { items_.reserve(size); }
  void resize(std::size_t size) { items_.resize(size); }
  void resize(std::size_t size, const T& value) { items_.resize(size, value); }
  void assign(std::size_t size, const T& value) { items_.assign(size, value); }
  void clear() { items_.clear(); }
  /// Takes out the elements that meet the condition; those behind move up.
  void erase_if(auto condition) { std::erase_if(items_, condition); }
  [[nodiscard]] reference back() {
    ORIEL_ASSERT(!empty());
    return items_.back();
  }
  [[nodiscard]] const_reference back() const {
    ORIEL_ASSERT(!empty());
    return items_.back();
  }

  [[nodiscard]] iterator begin() { return items_.begin(); }
  [[nodiscard]] iterator end() { return items_.end(); }
  [[nodiscard]] const_iterator begin() const { return items_.begin(); }
  [[nodiscard]] const_iterator end() const { return items_.end(); }

  /// The plain list, where ids play no part.
  [[nodiscard]] const std::vector<T>& items() const { return items_; }
  [[nodiscard]] std::vector<T> take_items() { return std::move(items_); }

  friend bool operator==(const IndexedVector&, const IndexedVector&) = default;

 private:
  std::vector<T> items_;
};

}  // namespace oriel
