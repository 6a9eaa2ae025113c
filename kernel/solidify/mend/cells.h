#pragma once

#include "kernel/base/index.h"
#include "kernel/solidify/shells/shell_mesh.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// What lies on the two sides of the polygons of a soup, as far as shared edges tell: going round
/// an edge the space between two polygons that follow each other is one, so their facing sides
/// belong to one cell. Each connected piece of the soup has one cell that holds all the space
/// around it, the outer one.
struct PolygonCells {
  /// Of every polygon the cell in front of it (where its normal points) and the one behind it.
  Numbers front, back;
  /// Of every polygon its piece: polygons linked by edges. Pieces count from 0.
  Numbers piece;
  int piece_count = 0;
  /// Of every piece its outer cell.
  Numbers outer;
  /// Edges of more than two polygons.
  int crowded_edges = 0;

  [[nodiscard]] bool is_front_outside(int polygon) const {
    return front[at(polygon)] == outer[at(piece[at(polygon)])];
  }
  [[nodiscard]] bool is_back_outside(int polygon) const {
    return back[at(polygon)] == outer[at(piece[at(polygon)])];
  }
  /// Outside on one side, a bounded cell on the other: part of the boundary of what is enclosed.
  [[nodiscard]] bool is_boundary(int polygon) const {
    return is_front_outside(polygon) != is_back_outside(polygon);
  }
};

/// `shapes` are those of the soup's polygons. The outer cell is the one of least volume, as its
/// boundary runs the wrong way round: minus all the others together.
PolygonCells find_cells(const Soup& soup, std::span<const PolygonShape> shapes);

}  // namespace oriel::detail
