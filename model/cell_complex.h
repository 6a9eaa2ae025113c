#pragma once

#include "kernel/base/ids.h"
#include "model/segmentation.h"
#include "model/solid.h"

#include <cstddef>
#include <span>
#include <vector>

namespace oriel {

/// A plane piece of the border between two cells, or between a cell and the outside.
struct Face {
  /// Its front is where the plane's normal points. Of the two orientations of a geometric plane the
  /// one with the smaller id.
  PlaneId plane;
  /// One outer loop (counter-clockwise seen from the front) first, then the loops of its holes;
  /// indices into CellComplex::vertices. Loops of faces that share a straight edge have the same
  /// vertices along it.
  std::vector<Loop> loops;
  /// The cells on either side; invalid: the outside. Never the same.
  CellId front;
  CellId behind;
  double area_m2 = 0;
};

/// A face of the boundary of some cells, and on which side they lie.
struct BoundaryFace {
  FaceId face;
  /// True: the cells lie in front of the face, so that its loops run clockwise seen from outside
  /// the cells.
  bool is_reversed = false;
  friend bool operator==(BoundaryFace, BoundaryFace) = default;
};

/// What two neighbours share.
struct Contact {
  CellId cell;  ///< the neighbour; invalid: the outside
  double area_m2 = 0;
};

/// The cells of a segmentation as a partition of space: each point belongs to one cell or to the
/// outside, and each face has exactly one on either side.
///
/// Leaves of the tree overlap: a void lies in the leaf that it was carved from, and what stands in
/// the void lies in both. A point belongs to the leaf that decides it in the tree, so to the
/// innermost one (docs/segmentation.md#the-cell-complex):
///  - a leaf decides of the points in it;
///  - in a union, of a point in a child's body that child decides; of a point in no child's body,
///    so of air, the first child that has a leaf to decide, the rest before the parts;
///  - in a difference, of a point in the rest's body, the part whose body it is in, else the first
///    part that has a leaf to decide; of all others the rest.
/// A point of which no leaf decides is outside. So solid cells together are the solid, void cells
/// are the air that was filled to find holes. A cell here is what others leave of its leaf: a wall
/// without its windows. It may be in several pieces, or nothing.
class CellComplex {
 public:
  CellComplex() = default;
  /// `faces` must be as Face says, with cells below `cell_count`.
  CellComplex(std::vector<Vertex> vertices, std::vector<Face> faces, std::size_t cell_count);

  /// Segmentation::vertices with the same indices (not all in use), then those that faces add.
  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }
  /// By plane, then cells behind and in front.
  [[nodiscard]] const std::vector<Face>& faces() const { return faces_; }
  [[nodiscard]] const Face& face(FaceId id) const { return faces_[id.index()]; }

  /// The faces around a cell, or around the outside (invalid); ascending.
  [[nodiscard]] std::span<const FaceId> faces_of(CellId cell) const;
  /// What a cell, or the outside, shares a face with; ascending, the outside first.
  [[nodiscard]] std::vector<Contact> neighbours(CellId cell) const;
  /// The area that two cells share; either may be the outside. 0 if they do not touch, or touch
  /// along an edge or in a vertex only.
  [[nodiscard]] double contact_area_m2(CellId a, CellId b) const;
  /// The boundary of some cells together, ascending: the faces with one of them on one side only.
  /// If open_edge_count() is 0 it is closed: each edge of a loop, taken in the sense of
  /// is_reversed, is met by an opposite one.
  [[nodiscard]] std::vector<BoundaryFace> boundary(std::span<const CellId> cells) const;
  /// The area of that boundary.
  [[nodiscard]] double boundary_area_m2(std::span<const CellId> cells) const;
  /// Edges along which the faces around some cell do not close, counted once for each such cell. 0
  /// but where vertices lie so far off their planes that sheets do not agree where they meet.
  [[nodiscard]] std::size_t open_edge_count() const;

 private:
  std::vector<Vertex> vertices_;
  std::vector<Face> faces_;
  /// By cell + 1, so that the outside is the first.
  std::vector<std::vector<FaceId>> faces_of_;
};

/// All cells of one sign: +1 solid, -1 void; ascending.
std::vector<CellId> cells_of_sign(const Segmentation& segmentation, int sign);

/// The cells of a feature and of all features found in it (Feature::parent), solid and void,
/// ascending; of an invalid feature, the body, all cells.
std::vector<CellId> cells_of(const Segmentation& segmentation, FeatureId feature);

}  // namespace oriel
