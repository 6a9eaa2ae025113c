#pragma once

#include "kernel/geometry/planar.h"
#include "kernel/model/solid.h"

#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace oriel::detail {

/// Splits facets of a solid along closed outlines in their planes, and keeps the solid closed.
class FacetSplitter {
 public:
  /// Corners nearer than `snap_m` to a vertex or an edge of the facet are put there.
  FacetSplitter(Solid solid, double snap_m);

  /// Splits a facet: the part inside the outline (counter-clockwise seen from outside) becomes a
  /// facet with the polygons of `inside`, what is left keeps the others. False if the outline
  /// leaves the facet.
  bool split(FacetId facet, const Outline& outline, const std::vector<int>& inside);

  [[nodiscard]] const Solid& solid() const { return solid_; }
  [[nodiscard]] Solid take() { return std::move(solid_); }

 private:
  using DirectedEdge = std::pair<int, int>;

  [[nodiscard]] Vec3 point(int v) const {
    return solid_.vertices[static_cast<std::size_t>(v)].point;
  }
  Facet& facet(int f) { return solid_.facets[static_cast<std::size_t>(f)]; }
  [[nodiscard]] Outline outline_of(const Loop& loop) const;
  void enter_edges(int f);
  void put(int place, int sibling, Facet made);
  std::optional<std::vector<Loop>> loops_left(int f, const Loop& ring, Vec3 normal,
                                              std::vector<Loop>& within);
  [[nodiscard]] std::optional<std::vector<std::vector<Loop>>> parts_of(
      const std::vector<Loop>& loops, Vec3 normal) const;
  int add_vertex(Vec3 p);
  std::optional<Loop> fitted(int f, const Outline& outline);
  std::optional<int> corner_at(int f, Vec3 p);
  void insert_on_edge(DirectedEdge edge, int vertex);
  void insert_into(int f, DirectedEdge edge, int vertex);
  [[nodiscard]] Loop with_vertices_between(const Loop& ring, int f) const;
  [[nodiscard]] std::optional<std::vector<Loop>> trace(const std::vector<DirectedEdge>& edges,
                                                       Vec3 normal) const;

  Solid solid_;
  double snap_m_;
  std::vector<int> shell_of_;
  std::map<DirectedEdge, int> facet_of_;  ///< by directed edge
  std::map<std::tuple<double, double, double>, int> made_;
};

}  // namespace oriel::detail
