#include "generalise/removal/facets.h"

#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/disjoint_sets.h"
#include "model/vec3.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace oriel::detail {

namespace {

/// Facets that share an edge have one number, the smallest of theirs.
std::vector<int> connected(const Solid& solid) {
  DisjointSets sets(solid.facets.size());
  struct EdgeOfFacet {
    int low, high, facet;
    auto operator<=>(const EdgeOfFacet&) const = default;
  };
  std::vector<EdgeOfFacet> edges;
  for_each_edge(solid, [&](int facet, int p, int q) {
    edges.push_back({std::min(p, q), std::max(p, q), facet});
  });
  std::ranges::sort(edges);
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i].low == edges[i - 1].low && edges[i].high == edges[i - 1].high)
      sets.unite(edges[i - 1].facet, edges[i].facet);
  std::vector<int> number(solid.facets.size());
  for (int i = 0; i < std::ssize(number); ++i) number[at(i)] = sets.find(i);
  return number;
}

/// What is known of a shell before it has its place.
struct ShellPiece {
  Shell shell;
  double volume_m3 = 0;
  Box box;
};

std::vector<ShellPiece> pieces_of(const Solid& solid) {
  const std::vector<int> number = connected(solid);
  std::map<int, ShellPiece> pieces;
  for (const FacetId f : ids_below<FacetId>(solid.facets.size())) {
    const Facet& facet = solid.facets[f.index()];
    ShellPiece& piece = pieces[number[f.index()]];
    piece.shell.facets.push_back(f);
    const Plane& plane = solid.planes[facet.plane.index()];
    piece.volume_m3 += plane.offset_m * area_m2(solid.vertices, facet, plane.normal) / 3;
    for (const int v : facet.loops[0]) piece.box.grow(solid.vertices[at(v)].point);
  }
  std::vector<ShellPiece> out;
  for (auto& [first, piece] : pieces) out.push_back(std::move(piece));
  return out;
}

}  // namespace

Plane plane_of(std::span<const Vertex> vertices, const Loop& outer) {
  const Vec3 first = vertices[at(outer[0])].point;
  Plane plane;
  plane.normal = normalised(
      area_vector(outer.size(), [&](std::size_t i) { return vertices[at(outer[i])].point; }));
  plane.offset_m = dot(plane.normal, first);
  return plane;
}

std::vector<Shell> shells_of(const Solid& solid) {
  std::vector<ShellPiece> pieces = pieces_of(solid);
  std::vector<Shell> shells;
  std::vector<Box> boxes;  // of lumps
  for (ShellPiece& piece : pieces) {
    if (piece.volume_m3 < 0) continue;
    piece.shell.lump = static_cast<int>(boxes.size());
    boxes.push_back(piece.box);
    shells.push_back(piece.shell);
  }
  for (ShellPiece& piece : pieces) {
    if (piece.volume_m3 >= 0) continue;
    piece.shell.is_cavity = true;
    double smallest = Box::kInfinity;
    for (std::size_t lump = 0; lump < boxes.size(); ++lump) {
      if (!is_within(piece.box, boxes[lump]) || volume_m3(boxes[lump]) >= smallest) continue;
      smallest = volume_m3(boxes[lump]);
      piece.shell.lump = static_cast<int>(lump);
    }
    shells.push_back(std::move(piece.shell));
  }
  std::ranges::stable_sort(shells, {}, &Shell::lump);
  return shells;
}

}  // namespace oriel::detail
