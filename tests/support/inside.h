#pragma once

#include "kernel/geometry/planar.h"
#include "model/segmentation.h"

#include <algorithm>
#include <random>
#include <span>
#include <vector>

namespace oriel::test {

/// A closed surface made of facets, to ask what is inside.
class Surface {
 public:
  Surface(std::span<const Vertex> vertices, const std::vector<Plane>& planes,
          const std::vector<Facet>& facets) {
    for (const Facet& facet : facets) {
      Piece& piece = pieces_.emplace_back();
      piece.normal = planes[facet.plane.index()].normal;
      for (const Loop& loop : facet.loops) {
        piece.outlines.emplace_back();
        for (const int v : loop)
          piece.outlines.back().push_back(vertices[static_cast<std::size_t>(v)].point);
      }
      for (const Vec3 p : piece.outlines[0]) box_.grow(p);
    }
  }

  [[nodiscard]] const Box& box() const { return box_; }

  [[nodiscard]] bool contains(Vec3 p) const {
    if (p.x < box_.min.x || p.y < box_.min.y || p.z < box_.min.z || p.x > box_.max.x ||
        p.y > box_.max.y || p.z > box_.max.z)
      return false;
    double winding = 0;
    for (const Piece& piece : pieces_) winding += winding_part(piece.outlines, p);
    return winding > 0.5;
  }

  /// `count` points, evenly drawn from a box a tenth larger than the surface's, those within
  /// `gap_m` of the plane of a facet left out; and as many close to facets, `near_m` before and
  /// behind them.
  [[nodiscard]] std::vector<Vec3> samples(int count, double gap_m, double near_m) const {
    std::mt19937_64 random(20041);
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<Vec3> points;
    const Vec3 size = box_.max - box_.min;
    for (int i = 0; i < count; ++i) {
      const double x = unit(), y = unit(), z = unit();
      points.push_back(box_.min + Vec3{(1.2 * x - 0.1) * size.x, (1.2 * y - 0.1) * size.y,
                                       (1.2 * z - 0.1) * size.z});
    }
    const std::size_t step =
        std::max<std::size_t>(1, 2 * pieces_.size() / static_cast<std::size_t>(count));
    for (std::size_t f = 0; f < pieces_.size(); f += step)
      if (const auto p = interior_point(pieces_[f].outlines, pieces_[f].normal)) {
        points.push_back(*p + near_m * pieces_[f].normal);
        points.push_back(*p - near_m * pieces_[f].normal);
      }
    std::erase_if(points, [&](Vec3 p) {
      return std::ranges::any_of(pieces_, [&](const Piece& piece) {
        return std::abs(dot(piece.normal, p - piece.outlines[0][0])) < gap_m;
      });
    });
    return points;
  }

 private:
  struct Piece {
    Vec3 normal;
    std::vector<Outline> outlines;
  };
  std::vector<Piece> pieces_;
  Box box_;
};

inline Surface surface_of(const Solid& solid) {
  return {solid.vertices, solid.planes, solid.facets};
}

/// A cell as a solid of its own.
inline Solid solid_of(const Segmentation& segmentation, const Cell& cell) {
  return {0, segmentation.planes, segmentation.vertices, cell.facets, {}};
}

/// Which cells a point is in, and what the tree makes of it.
class Cells {
 public:
  explicit Cells(const Segmentation& segmentation) : segmentation_(segmentation) {
    for (const Cell& cell : segmentation.cells)
      surfaces_.emplace_back(segmentation.vertices, segmentation.planes, cell.facets);
  }

  void look_at(Vec3 p) {
    is_in_.clear();
    for (const Surface& surface : surfaces_) is_in_.push_back(surface.contains(p) ? 1 : 0);
  }

  [[nodiscard]] int sum_of_signs() const {
    int sum = 0;
    for (std::size_t c = 0; c < is_in_.size(); ++c)
      if (is_in_[c] != 0) sum += segmentation_.cells[c].sign;
    return sum;
  }

  /// The union or difference that the node says.
  [[nodiscard]] bool is_in(NodeId id) const {
    const CsgNode& node = segmentation_.nodes[id.index()];
    if (node.kind == CsgNode::Kind::leaf) return is_in_[node.cell.index()] != 0;
    const auto is_in_one = [&](const std::vector<NodeId>& nodes) {
      return std::ranges::any_of(nodes, [&](NodeId n) { return is_in(n); });
    };
    if (node.kind == CsgNode::Kind::unite) return is_in_one(node.rest) || is_in_one(node.parts);
    return is_in_one(node.rest) && !is_in_one(node.parts);
  }

 private:
  const Segmentation& segmentation_;
  std::vector<Surface> surfaces_;
  std::vector<char> is_in_;
};

}  // namespace oriel::test
