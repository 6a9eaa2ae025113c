#include "tests/fuzz/support/nef.h"

#include "kernel/base/index.h"
#include "kernel/mesh/triangulate.h"
#include "tests/fuzz/support/bodies.h"

#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <CGAL/Exact_integer.h>
#include <CGAL/Homogeneous.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>

namespace oriel::fuzz {

namespace {

using JudgeKernel = CGAL::Homogeneous<CGAL::Exact_integer>;
using JudgePolyhedron = CGAL::Polyhedron_3<JudgeKernel>;
using JudgeNef = CGAL::Nef_polyhedron_3<JudgeKernel>;

constexpr std::size_t kMostTriangles = 200;

/// What cannot be judged.
struct NotJudged {};

/// The triangles of a closed surface, corners counted anew.
struct NefSurface {
  std::vector<std::array<double, 3>> points;  ///< in units
  std::vector<std::array<std::size_t, 3>> triangles;
};

class NefBuild : public CGAL::Modifier_base<JudgePolyhedron::HalfedgeDS> {
 public:
  explicit NefBuild(const NefSurface& surface) : surface_(surface) {}

  void operator()(JudgePolyhedron::HalfedgeDS& structure) override {
    CGAL::Polyhedron_incremental_builder_3<JudgePolyhedron::HalfedgeDS> builder(structure);
    builder.begin_surface(surface_.points.size(), surface_.triangles.size());
    for (const auto& [x, y, z] : surface_.points)
      builder.add_vertex(JudgeKernel::Point_3(CGAL::Exact_integer(x), CGAL::Exact_integer(y),
                                              CGAL::Exact_integer(z)));
    for (const auto& corners : surface_.triangles) {
      if (!builder.test_facet(corners.begin(), corners.end())) throw NotJudged{};
      builder.add_facet(corners.begin(), corners.end());
    }
    builder.end_surface();
  }

 private:
  const NefSurface& surface_;
};

class NefJudge {
 public:
  explicit NefJudge(const Segmentation& segmentation) : segmentation_(segmentation) {}

  bool is_tree(const Solid& solid) {
    const JudgeNef tree = node(segmentation_.root), whole = body(solid);
    return (tree - whole).interior().is_empty() && (whole - tree).interior().is_empty();
  }

 private:
  JudgeNef node(NodeId id) {
    const CsgNode& node_of = segmentation_.nodes[id.index()];
    if (node_of.kind == CsgNode::Kind::leaf) {
      const Cell& cell = segmentation_.cells[node_of.cell.index()];
      NefSurface surface;
      for (const Facet& facet : cell.facets)
        add(segmentation_.vertices, facet, segmentation_.planes[facet.plane.index()], surface);
      return nef(surface);
    }
    JudgeNef out(JudgeNef::EMPTY);
    for (const NodeId rest : node_of.rest) out += node(rest);
    for (const NodeId part : node_of.parts) {
      if (node_of.kind == CsgNode::Kind::unite)
        out += node(part);
      else
        out -= node(part);
    }
    return out;
  }

  /// Lumps without their cavities, in which other lumps may stand.
  JudgeNef body(const Solid& solid) {
    std::map<int, JudgeNef> lumps;
    for (const bool are_cavities : {false, true})
      for (const Shell& shell : solid.shells) {
        if (shell.is_cavity != are_cavities) continue;
        JudgeNef& lump = lumps.try_emplace(shell.lump, JudgeNef::EMPTY).first->second;
        lump = are_cavities ? lump - of_shell(solid, shell) : of_shell(solid, shell);
      }
    JudgeNef out(JudgeNef::EMPTY);
    for (const auto& [number, lump] : lumps) out += lump;
    return out;
  }

  /// Cavities are drawn as the air in them looks, so their triangles are turned.
  JudgeNef of_shell(const Solid& solid, const Shell& shell) {
    NefSurface surface;
    for (const FacetId f : shell.facets) {
      const Facet& facet = solid.facets[f.index()];
      add(solid.vertices, facet, solid.planes[facet.plane.index()], surface);
    }
    for (auto& corners : surface.triangles)
      if (shell.is_cavity) std::swap(corners[1], corners[2]);
    return nef(surface);
  }

  void add(std::span<const Vertex> vertices, const Facet& facet, const Plane& plane,
           NefSurface& surface) {
    std::vector<Vec3> points;
    std::vector<std::size_t> number;
    std::vector<std::vector<int>> rings;
    for (const Loop& loop : facet.loops) {
      rings.emplace_back();
      for (const int v : loop) {
        rings.back().push_back(static_cast<int>(points.size()));
        points.push_back(vertices[at(v)].point);
        number.push_back(corner(points.back(), surface));
      }
    }
    for (const auto& [a, b, c] : triangulate(points, rings, plane.normal)) {
      if (++triangles_ > kMostTriangles) throw NotJudged{};
      surface.triangles.push_back({number[at(a)], number[at(b)], number[at(c)]});
    }
  }

  static std::size_t corner(Vec3 p, NefSurface& surface) {
    std::array<double, 3> point{p.x, p.y, p.z};
    for (double& number : point) {
      const double whole = std::round(number / kUnit_m);
      if (whole * kUnit_m != number) throw NotJudged{};
      number = whole;
    }
    for (std::size_t i = 0; i < surface.points.size(); ++i)
      if (surface.points[i] == point) return i;
    surface.points.push_back(point);
    return surface.points.size() - 1;
  }

  static JudgeNef nef(const NefSurface& surface) {
    JudgePolyhedron polyhedron;
    NefBuild build(surface);
    polyhedron.delegate(build);
    if (!polyhedron.is_closed()) throw NotJudged{};
    return JudgeNef(polyhedron);
  }

  const Segmentation& segmentation_;
  std::size_t triangles_ = 0;
};

}  // namespace

std::optional<bool> is_solid_by_nef(const Segmentation& segmentation, const Solid& solid) {
  try {
    return NefJudge(segmentation).is_tree(solid);
  } catch (const NotJudged&) {
    return std::nullopt;
  }
}

}  // namespace oriel::fuzz
