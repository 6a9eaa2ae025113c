#pragma once

#include "kernel/segment/complex/owners.h"
#include "kernel/segment/complex/refine.h"
#include "kernel/segment/complex/vertex_pool.h"
#include "model/cell_complex.h"
#include "model/segmentation.h"

#include <map>
#include <span>
#include <utility>
#include <vector>

namespace oriel::detail {

/// Cells where one plane meets them. Their vertices are those of the pool. Which cells are just in
/// front of the plane, and which just behind it, is asked of the sections at P + 0 and P - 0:
/// points on the plane count as on the other side, so no degenerate case is left.
class Slicer {
 public:
  /// `is_on` says by vertex which ones lie on the plane, whatever their coordinates.
  Slicer(std::span<const Plane> planes, PlaneId plane, std::span<const char> is_on,
         VertexPool& pool)
      : planes_(planes), plane_(planes[plane.index()]), is_on_(is_on), pool_(pool) {}

  /// -1, 0, +1: behind, on, in front of the plane.
  [[nodiscard]] int side(int vertex) const;
  /// True if the cell has vertices on both sides.
  [[nodiscard]] bool passes(std::span<const int> vertices) const;
  /// Appends the outlines of the cell's two sections. For each label they are closed.
  void add_sections(CellId cell, std::span<const Facet> facets, std::vector<Chord>& chords);
  /// Appends the outline of a facet that lies in the plane.
  void add_facet(CellId cell, const Facet& facet, std::vector<Chord>& chords) const;

 private:
  void add_section(const Facet& facet, int label, std::vector<Chord>& chords);
  int cross_edge(int a, int b);

  std::span<const Plane> planes_;
  const Plane& plane_;
  std::span<const char> is_on_;
  VertexPool& pool_;
  std::map<std::pair<int, int>, int> crossings_;
};

/// The faces in one plane, without areas: the maximal connected pieces with the same two cells on
/// either side. `chords` are the outlines of all cells just in front of the plane and just behind.
/// None once `work` is used up.
std::vector<Face> faces_of_sheet(PlaneId plane, Vec3 normal, std::vector<Chord> chords,
                                 Owners& owners, VertexPool& pool, Work& work);

}  // namespace oriel::detail
