#pragma once

#include "kernel/segment/complex/cell_complex.h"
#include "model/cell_complex.h"
#include "tests/support/inside.h"
#include "tests/support/segmented.h"

#include <span>
#include <vector>

namespace oriel::test {

/// Which cell a point belongs to, asked of the tree node by node as CellComplex defines it; slow,
/// and shares nothing with the kernel's.
class SlowOwner {
 public:
  explicit SlowOwner(const Segmentation& segmentation)
      : segmentation_(segmentation), cells_(segmentation) {}

  /// Invalid: the outside.
  CellId operator()(Vec3 point) {
    cells_.look_at(point);
    return of(segmentation_.root);
  }

 private:
  [[nodiscard]] CellId of(NodeId id) const {
    const CsgNode& node = segmentation_.nodes[id.index()];
    if (node.kind == CsgNode::Kind::leaf) return cells_.is_in(id) ? node.cell : CellId{};
    if (node.kind == CsgNode::Kind::subtract) {
      const bool is_in_rest =
          std::ranges::any_of(node.rest, [&](NodeId rest) { return cells_.is_in(rest); });
      const CellId in_part = is_in_rest ? first_of(node.parts) : CellId{};
      return in_part.is_valid() ? in_part : first_of(node.rest);
    }
    std::vector<NodeId> children = node.rest;
    children.insert(children.end(), node.parts.begin(), node.parts.end());
    return first_of(children);
  }

  [[nodiscard]] CellId first_of(const std::vector<NodeId>& children) const {
    for (const NodeId child : children)
      if (cells_.is_in(child)) return of(child);
    for (const NodeId child : children)
      if (const CellId found = of(child); found.is_valid()) return found;
    return {};
  }

  const Segmentation& segmentation_;
  Cells cells_;
};

/// How exact the body is.
struct ComplexExactness {
  double area_rel = 1e-9;
  /// How far on either side of a face the cells are asked for; thinner faces are not asked.
  double probe_m = 1e-5;
  /// Every n-th face is asked.
  int probe_every = 1;
  /// False if a ring of the input pokes out of its facet: the facets then have less area than the
  /// surface.
  bool has_sound_rings = true;
};

/// Everything that holds for the cell complex of every segmentation.
void check_complex(const Segmented& s, const CellComplex& complex,
                   const ComplexExactness& exactness = {});

/// The volume inside a boundary.
double volume_m3(const Segmentation& segmentation, const CellComplex& complex,
                 std::span<const CellId> cells);

}  // namespace oriel::test
