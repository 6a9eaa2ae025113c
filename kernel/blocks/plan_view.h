#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/segment/complex/arrangement.h"
#include "kernel/segment/complex/vertex_pool.h"
#include "model/solid.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace oriel::detail {

/// A solid seen from above: the plan is divided into regions by the outlines of all facets that
/// look up, and of the ground facets. Region 0 is what lies around.
class PlanView {
 public:
  /// Points of the plan nearer than `reach_m` are one. Nothing is seen once `work` is used up.
  PlanView(const Solid& solid, double ground_reach_m, double reach_m, Work& work);

  struct PlanRegion {
    /// The facet seen in it; -1: none.
    int top = -1;
    bool is_on_ground = false;  ///< a ground facet lies under it
    bool is_thin = false;       ///< narrower than the reach
    double area_m2 = 0;
    /// Its outlines with its interior to the left, z = 0.
    std::vector<Outline> outlines;
  };

  [[nodiscard]] const std::vector<PlanRegion>& regions() const { return regions_; }
  [[nodiscard]] const Arrangement& arrangement() const { return *arrangement_; }
  /// A vertex of the arrangement, z = 0.
  [[nodiscard]] Vec3 point(int vertex) const { return pool_.at(vertex); }
  /// The height of a facet's plane over a point of the plan.
  [[nodiscard]] double height_m(int facet, Vec3 point) const;
  /// The lowest point of the ground facets, or of the solid if it has none.
  [[nodiscard]] double ground_m() const { return ground_m_; }

 private:
  void add_outlines(int facet, bool is_reversed, std::vector<Chord>& chords);
  void trace_regions();
  void find_tops();

  const Solid& solid_;
  VertexPool pool_;
  std::vector<char> is_ground_;  ///< by facet
  double ground_m_ = 0;
  std::vector<PlanarEdge> edges_;
  std::unique_ptr<Arrangement> arrangement_;
  std::vector<PlanRegion> regions_;
};

}  // namespace oriel::detail
