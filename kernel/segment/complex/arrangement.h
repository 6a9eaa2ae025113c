#pragma once

#include "kernel/segment/complex/refine.h"
#include "kernel/segment/complex/vertex_pool.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace oriel {

/// What edges of one plane, none of which cross, divide it into. Half-edge 2e runs from a to b of
/// edge e, 2e + 1 back; each has a region to its left. Region 0 is the unbounded one.
class Arrangement {
 public:
  Arrangement(std::span<const PlanarEdge> edges, const PlaneAxes& axes, const VertexPool& pool);

  static std::size_t twin(std::size_t half_edge) { return half_edge ^ 1U; }
  [[nodiscard]] std::size_t half_edge_count() const { return 2 * edges_.size(); }
  [[nodiscard]] int origin(std::size_t half_edge) const {
    const PlanarEdge& edge = edges_[half_edge / 2];
    return half_edge % 2 == 0 ? edge.a : edge.b;
  }
  /// The half-edge that follows along the region to the left.
  [[nodiscard]] std::size_t next(std::size_t half_edge) const { return next_[half_edge]; }
  [[nodiscard]] std::size_t region_count() const { return region_count_; }
  [[nodiscard]] std::size_t region(std::size_t half_edge) const {
    return region_of_cycle_[cycle_[half_edge]];
  }

  /// How often labels hold in a region, by label; those that hold 0 times are left out.
  using Windings = std::vector<std::pair<int, int>>;
  /// For each region.
  [[nodiscard]] std::vector<Windings> windings() const;
  /// For each region the labels that hold in it more than 0 times, ascending.
  [[nodiscard]] std::vector<std::vector<int>> labels() const;

 private:
  /// An outline of a region: of its outer boundary (counter-clockwise) or around what lies in it.
  struct Cycle {
    std::size_t leftmost;  ///< a half-edge from the leftmost vertex
    bool is_outer = false;
  };

  void order_around_vertices();
  void trace_cycles();
  void nest();
  [[nodiscard]] Vec2 at(std::size_t half_edge) const { return position_[vertex_[half_edge]]; }
  /// The half-edge nearest to the left of a point, just above it, that looks at it; or none.
  [[nodiscard]] std::size_t nearest_to_the_left(Vec2 point) const;

  std::span<const PlanarEdge> edges_;
  std::vector<std::size_t> vertex_;  ///< of the origins, numbered here
  std::vector<Vec2> position_;
  std::vector<std::size_t> next_;
  std::vector<std::size_t> cycle_;
  std::vector<Cycle> cycles_;
  std::vector<std::size_t> region_of_cycle_;
  std::size_t region_count_ = 1;
};

/// The half-edges of a border in their order, from `start` on, which is one of them; they are
/// marked in `is_traced`. `is_border(h)` says what the border is, of both half-edges of an edge the
/// same.
template <class IsBorder>
std::vector<std::size_t> border_from(const Arrangement& plan, std::size_t start, IsBorder is_border,
                                     std::vector<char>& is_traced) {
  std::vector<std::size_t> border;
  for (std::size_t h = start; is_traced[h] == 0;) {
    is_traced[h] = 1;
    border.push_back(h);
    for (h = plan.next(h); !is_border(h);) h = plan.next(Arrangement::twin(h));
  }
  return border;
}

}  // namespace oriel
