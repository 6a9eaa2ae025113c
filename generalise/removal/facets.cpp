#include "generalise/removal/facets.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace oriel::detail {

namespace {

bool is_inside(const Box& inner, const Box& outer) {
  return inner.min.x >= outer.min.x && inner.min.y >= outer.min.y && inner.min.z >= outer.min.z &&
         inner.max.x <= outer.max.x && inner.max.y <= outer.max.y && inner.max.z <= outer.max.z;
}

double size_of(const Box& box) {
  const Vec3 d = box.max - box.min;
  return d.x * d.y * d.z;
}

/// Facets that share an edge have one number, the smallest of theirs.
std::vector<int> connected(const Solid& solid) {
  std::vector<int> parent(solid.facets.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int i) {
    while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
    return i;
  };
  std::map<std::pair<int, int>, int> facet_at;
  for_each_edge(solid, [&](int facet, int p, int q) {
    const auto [first, is_new] = facet_at.emplace(std::minmax(p, q), facet);
    if (is_new) return;
    const int i = find(first->second), j = find(facet);
    parent[at(std::max(i, j))] = std::min(i, j);
  });
  for (int i = 0; i < std::ssize(parent); ++i) parent[at(i)] = find(i);
  return parent;
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
  for (int f = 0; f < std::ssize(solid.facets); ++f) {
    const Facet& facet = solid.facets[at(f)];
    ShellPiece& piece = pieces[number[at(f)]];
    piece.shell.facets.push_back(FacetId{f});
    const Plane& plane = solid.planes[facet.plane.index()];
    piece.volume_m3 += plane.offset_m * area_m2(solid.vertices, facet, plane.normal) / 3;
    for (const int v : facet.loops[0]) piece.box.grow(solid.vertices[at(v)].point);
  }
  std::vector<ShellPiece> out;
  for (auto& [first, piece] : pieces) out.push_back(std::move(piece));
  return out;
}

}  // namespace

void for_each_edge(const Solid& solid, const std::function<void(int, int, int)>& visit) {
  for (int f = 0; f < std::ssize(solid.facets); ++f)
    for (const Loop& loop : solid.facets[at(f)].loops)
      for (std::size_t i = 0; i < loop.size(); ++i) visit(f, loop[i], loop[(i + 1) % loop.size()]);
}

Plane plane_of(std::span<const Vertex> vertices, const Loop& outer) {
  const Vec3 first = vertices[at(outer[0])].point;
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < outer.size(); ++i)
    sum =
        sum + cross(vertices[at(outer[i])].point - first, vertices[at(outer[i + 1])].point - first);
  Plane plane;
  plane.normal = normalised(sum);
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
      if (!is_inside(piece.box, boxes[lump]) || size_of(boxes[lump]) >= smallest) continue;
      smallest = size_of(boxes[lump]);
      piece.shell.lump = static_cast<int>(lump);
    }
    shells.push_back(std::move(piece.shell));
  }
  std::ranges::stable_sort(shells, {}, &Shell::lump);
  return shells;
}

}  // namespace oriel::detail
