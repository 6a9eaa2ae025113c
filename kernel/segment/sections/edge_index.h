#pragma once

#include "kernel/segment/boundary/boundary.h"
#include "kernel/segment/boundary/growing_lists.h"
#include "kernel/segment/planes/plane_ranks.h"

#include <cstddef>
#include <span>
#include <vector>

namespace oriel::detail {

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
  [[nodiscard]] std::span<const int> edges_at(std::size_t entry, int direction) {
    const Place& place = places_[entry];
    Class& c = classes_[place.number];
    if (c.entered < edges_.size()) enter(c);
    return c.lists[place.gap + (direction > 0 ? 1 : 0)];
  }

  /// Takes in the half-edges that were made since the last time.
  void update();

  /// The ranks of those of the planes that are of the k-th of their classes.
  [[nodiscard]] const PlaneRanks& ranks_of_class(std::size_t k) {
    Class& c = classes_[k];
    if (!c.ranks.is_ready()) make_table(c);
    return c.ranks;
  }

 private:
  /// A living half-edge that speaks for its edge.
  struct Edge {
    int half, from, to;
  };
  struct Class {
    int number;
    PlaneRanks ranks;
    GrowingLists lists = {};  ///< half-edges by gap
    std::size_t entered = 0;  ///< how many of edges_
  };
  /// A half-edge whose edge is not level, and the gaps that it runs through.
  struct Run {
    int half;
    std::size_t first, last;
  };
  /// The gap behind a plane.
  struct Place {
    std::size_t number;  ///< of its class
    std::size_t gap;
  };
  void enter(Class& c);
  void make_table(Class& c) const;
  void find_new_runs(const Class& c);

  const Boundary& body_;
  std::vector<Class> classes_;
  std::vector<Place> places_;  ///< by plane
  std::vector<Edge> edges_;    ///< as they came
  int known_ = 0;              ///< half-edges taken in
  std::vector<Run> runs_;      ///< of the class at hand
};

}  // namespace oriel::detail
