#include "kernel/segment/segment_open.h"

namespace oriel {

Segmentation segment_open(const Solid& open_shell) {
  Segmentation out;
  out.grid_m = open_shell.grid_m;
  out.planes = open_shell.planes;
  out.vertices = open_shell.vertices;
  Cell cell;
  cell.is_convex = false;
  cell.flag = LeafFlag::open;
  cell.node = NodeId{0};
  cell.facets = open_shell.facets;
  out.cells.push_back(std::move(cell));
  CsgNode leaf;
  leaf.cell = CellId{0};
  out.nodes.push_back(std::move(leaf));
  out.root = NodeId{0};
  out.stats.leaves = out.stats.recursions = 1;
  return out;
}

}  // namespace oriel
