#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace oriel::detail {

/// Lists of numbers that only grow, in one piece of memory: a list that is full moves to the end
/// and gets twice the room. For many short lists that are made at one time.
class GrowingLists {
 public:
  /// Makes empty lists with room for that many numbers each.
  void make(std::span<const int> rooms) {
    lists_.clear();
    std::size_t begin = 0;
    for (const int room : rooms) {
      lists_.push_back({begin, 0, static_cast<std::size_t>(room)});
      begin += static_cast<std::size_t>(room);
    }
    numbers_.assign(begin, 0);
  }

  /// Valid until the next push_back().
  [[nodiscard]] std::span<const int> operator[](std::size_t i) const {
    return std::span(numbers_).subspan(lists_[i].begin, lists_[i].size);
  }

  void push_back(std::size_t i, int number) { push_back(i, i, number); }
  /// To the lists from `first` to `last`, which have room left.
  void push_back_in_room(std::size_t first, std::size_t last, int number) {
    for (List *list = &lists_[first], *end = &lists_[last] + 1; list != end; ++list)
      numbers_[list->begin + list->size++] = number;
  }
  /// To the lists from `first` to `last`.
  void push_back(std::size_t first, std::size_t last, int number) {
    for (std::size_t i = first; i <= last; ++i) {
      List& list = lists_[i];
      if (list.size == list.room) move_to_end(list);
      numbers_[list.begin + list.size++] = number;
    }
  }

 private:
  struct List {
    std::size_t begin, size, room;
  };
  void move_to_end(List& list) {
    const std::size_t begin = numbers_.size();
    list.room = std::max<std::size_t>(4, 2 * list.room);
    numbers_.resize(begin + list.room);
    std::copy_n(numbers_.begin() + static_cast<std::ptrdiff_t>(list.begin), list.size,
                numbers_.begin() + static_cast<std::ptrdiff_t>(begin));
    list.begin = begin;
  }

  std::vector<int> numbers_;
  std::vector<List> lists_;
};

}  // namespace oriel::detail
