#pragma once

#include "kernel/segment/boundary/boundary.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace oriel::detail {

/// Lists that only grow, in one piece of memory: a list that is full moves to the end
/// and gets twice the room. For many short lists that are made at one time.
template <class T>
class GrowingLists {
 public:
  /// Makes empty lists with room for that many items each.
  void make(std::span<const int> rooms) {
    lists_.clear();
    std::size_t begin = 0;
    for (const int room : rooms) {
      lists_.push_back({begin, 0, static_cast<std::size_t>(room)});
      begin += static_cast<std::size_t>(room);
    }
    items_.assign(begin, T{});
  }

  /// Valid until the next push_back().
  [[nodiscard]] std::span<const T> operator[](std::size_t i) const {
    return std::span(items_).subspan(lists_[i].begin, lists_[i].size);
  }

  void push_back(std::size_t i, T item) { push_back(i, i, item); }
  /// To the lists from `first` to `last`, which have room left.
  void push_back_in_room(std::size_t first, std::size_t last, T item) {
    for (List *list = &lists_[first], *end = &lists_[last] + 1; list != end; ++list)
      items_[list->begin + list->size++] = item;
  }
  /// To the lists from `first` to `last`.
  void push_back(std::size_t first, std::size_t last, T item) {
    for (std::size_t i = first; i <= last; ++i) {
      List& list = lists_[i];
      if (list.size == list.room) move_to_end(list);
      items_[list.begin + list.size++] = item;
    }
  }

 private:
  struct List {
    std::size_t begin, size, room;
  };
  void move_to_end(List& list) {
    const std::size_t begin = items_.size();
    list.room = std::max<std::size_t>(4, 2 * list.room);
    items_.resize(begin + list.room);
    std::copy_n(items_.begin() + static_cast<std::ptrdiff_t>(list.begin), list.size,
                items_.begin() + static_cast<std::ptrdiff_t>(begin));
    list.begin = begin;
  }

  std::vector<T> items_;
  std::vector<List> lists_;
};

/// The ranks of some planes of one normal class, ascending.
class PlaneRanks {
 public:
  void push_back(int rank) { ranks_.push_back(rank); }
  [[nodiscard]] std::size_t size() const { return ranks_.size(); }
  [[nodiscard]] int operator[](std::size_t i) const { return ranks_[i]; }

  /// To be called once, with the number of planes that the class has: lets before() look up instead
  /// of search, unless these are many more than those asked for.
  void make_table(std::size_t planes_of_class) {
    is_ready_ = true;
    constexpr std::size_t kMany = 8;  // times: then searching costs less than a table
    const std::size_t ranks = 2 * planes_of_class + 2;
    if (ranks > kMany * ranks_.size()) return;
    before_.reserve(ranks);
    for (std::size_t rank = 0, i = 0; rank < ranks; ++rank) {
      while (i < ranks_.size() && ranks_[i] < static_cast<int>(rank)) ++i;
      before_.push_back(static_cast<int>(i));
    }
  }
  [[nodiscard]] bool is_ready() const { return is_ready_; }

  /// How many of the planes have a lesser rank than this, which need not be one of the class.
  [[nodiscard]] std::size_t before(int rank) const {
    if (rank <= 0) return 0;
    const auto place = static_cast<std::size_t>(rank);
    if (place < before_.size()) return static_cast<std::size_t>(before_[place]);
    if (!before_.empty()) return ranks_.size();
    return static_cast<std::size_t>(std::ranges::lower_bound(ranks_, rank) - ranks_.begin());
  }

 private:
  std::vector<int> ranks_;
  std::vector<int> before_;  ///< by rank; empty: to be searched for
  bool is_ready_ = false;
};

/// The edges that sections of a body may cross, so that a section costs what it meets and not what
/// the body has. The split planes of a normal class leave gaps between them, and one before the
/// first and behind the last; an edge is entered in each gap that it runs through, and the section
/// at P ± 0 is that of the gap there. Edges are entered class by class, when the first of a class
/// are asked for: of many a class none is before nearly all of the body is cut off.
class EdgeIndex {
 public:
  /// `planes`: those that will be asked for, ascending.
  EdgeIndex(const Boundary& body, const std::vector<int>& planes);

  /// A half-edge of every living edge that runs through the gap in front of a plane (`direction`
  /// +1, as its class has it), or behind it (-1); dead edges and some that were shortened since may
  /// be among them. `entry` counts in `planes`.
  [[nodiscard]] std::span<const EdgeId> edges_at(std::size_t entry, int direction) {
    const GapPlace& place = places_[entry];
    EdgesOfClass& c = classes_[place.number];
    if (c.entered < edges_.size()) enter(c);
    return c.lists[place.gap + (direction > 0 ? 1 : 0)];
  }

  /// Takes in the half-edges that were made since the last time.
  void update();

  /// The ranks of those of the planes that are of the k-th of their classes.
  [[nodiscard]] const PlaneRanks& ranks_of_class(std::size_t k) {
    EdgesOfClass& c = classes_[k];
    if (!c.ranks.is_ready()) make_table(c);
    return c.ranks;
  }

 private:
  /// A living half-edge that speaks for its edge.
  struct IndexedEdge {
    EdgeId half;
    int from, to;
  };
  struct EdgesOfClass {
    int number;
    PlaneRanks ranks;
    GrowingLists<EdgeId> lists = {};  ///< half-edges by gap
    std::size_t entered = 0;          ///< how many of edges_
  };
  /// A half-edge whose edge is not level, and the gaps that it runs through.
  struct GapRun {
    EdgeId half;
    std::size_t first, last;
  };
  /// The gap behind a plane.
  struct GapPlace {
    std::size_t number;  ///< of its class
    std::size_t gap;
  };
  void enter(EdgesOfClass& c);
  void make_table(EdgesOfClass& c) const;
  void find_new_runs(const EdgesOfClass& c);

  const Boundary& body_;
  std::vector<EdgesOfClass> classes_;
  std::vector<GapPlace> places_;    ///< by plane
  std::vector<IndexedEdge> edges_;  ///< as they came
  int known_ = 0;                   ///< half-edges taken in
  std::vector<GapRun> runs_;        ///< of the class at hand
};

}  // namespace oriel::detail
