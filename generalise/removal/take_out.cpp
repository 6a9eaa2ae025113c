#include "generalise/removal/building_cells.h"
#include "generalise/removal/facets.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/exact.h"
#include "kernel/segment/complex/body_without.h"
#include "model/cell_complex.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

using ExactPlaneKey = std::pair<std::array<std::int64_t, 3>, std::int64_t>;

ExactPlaneKey exact_key_of(const Plane& plane) { return {plane.coefficients, plane.offset}; }

/// Facets narrower than weld_m.
std::ptrdiff_t slivers_of(const Solid& solid, double weld_m) {
  return std::ranges::count_if(solid.facets, [&](const Facet& facet) {
    double outline_m = 0;
    for (const Loop& loop : facet.loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        outline_m += length(solid.vertices[at(loop[i])].point -
                            solid.vertices[at(loop[(i + 1) % loop.size()])].point);
    const Vec3 normal = solid.planes[facet.plane.index()].normal;
    return 2 * area_m2(solid.vertices, facet, normal) < weld_m * outline_m;
  });
}

/// Edges at which the solid touches itself.
std::ptrdiff_t doubled_edges_of(const Solid& solid) {
  std::vector<std::pair<int, int>> edges;
  for_each_edge(solid, [&](int, int from, int to) { edges.emplace_back(from, to); });
  std::ranges::sort(edges);
  return edges.end() - std::unique(edges.begin(), edges.end());
}

/// Makes a solid of the faces around the one cell of a complex.
class SolidOfFaces {
 public:
  SolidOfFaces(const Solid& before, const Segmentation& segmentation, const CellComplex& complex)
      : segmentation_(segmentation), complex_(complex) {
    out_.grid_m = before.grid_m;
    out_.planes = before.planes;
    for (const PlaneId p : ids_below<PlaneId>(out_.planes.size()))
      planes_.emplace(exact_key_of(out_.planes[p.index()]), p);
  }

  Solid run() {
    for (const BoundaryFace& part : complex_.boundary(std::array{CellId{0}})) add(part);
    drop_straight_vertices();
    number_vertices();
    out_.shells = shells_of(out_);
    return std::move(out_);
  }

 private:
  void add(BoundaryFace part) {
    const Face& face = complex_.face(part.face);
    const Plane& plane = segmentation_.planes[face.plane.index()];
    Facet facet{plane_number(part.is_reversed ? exact::opposite(plane) : plane), face.loops, {}};
    if (part.is_reversed)
      for (Loop& loop : facet.loops) std::ranges::reverse(loop);
    out_.facets.push_back(std::move(facet));
  }

  PlaneId plane_number(const Plane& plane) {
    const auto [entry, is_new] =
        planes_.try_emplace(exact_key_of(plane), PlaneId{static_cast<int>(out_.planes.size())});
    if (is_new) out_.planes.push_back(plane);
    return entry->second;
  }

  /// Where two facets only meet in a vertex their edge goes on there.
  void drop_straight_vertices() {
    for (std::size_t before = 0, now = corners(); before != now; now = corners()) {
      before = now;
      std::vector<int> uses(complex_.vertices().size());
      for (const Facet& facet : out_.facets)
        for (const Loop& loop : facet.loops)
          for (const int v : loop) ++uses[at(v)];
      for (Facet& facet : out_.facets) {
        for (Loop& loop : facet.loops) {
          std::erase_if(loop, [&](int v) { return uses[at(v)] == 2; });
          drop_spikes(loop);
        }
        std::erase_if(facet.loops, [](const Loop& loop) { return loop.size() < 3; });
      }
      std::erase_if(out_.facets, [](const Facet& facet) { return facet.loops.empty(); });
    }
  }

  /// Where a loop goes to a vertex and back the same way.
  static void drop_spikes(Loop& loop) {
    Loop kept;
    for (const int v : loop) {
      if (!kept.empty() && kept.back() == v) continue;
      if (kept.size() > 1 && kept[kept.size() - 2] == v)
        kept.pop_back();
      else
        kept.push_back(v);
    }
    while (kept.size() > 2 && (kept.front() == kept.back() || kept[kept.size() - 2] == kept[0]))
      kept.pop_back();
    if (kept.size() > 2 && kept.back() == kept[1]) kept.erase(kept.begin(), kept.begin() + 1);
    if (kept.size() > 2 && kept.back() == kept[0]) kept.pop_back();
    loop = std::move(kept);
  }

  [[nodiscard]] std::size_t corners() const {
    std::size_t count = 0;
    for (const Facet& facet : out_.facets)
      for (const Loop& loop : facet.loops) count += loop.size();
    return count;
  }

  void number_vertices() {
    std::vector<int> numbers(complex_.vertices().size(), -1);
    for (Facet& facet : out_.facets)
      for (Loop& loop : facet.loops)
        for (int& v : loop) {
          int& number = numbers[at(v)];
          if (number < 0) {
            number = static_cast<int>(out_.vertices.size());
            out_.vertices.push_back(complex_.vertices()[at(v)]);
          }
          v = number;
        }
  }

  const Segmentation& segmentation_;
  const CellComplex& complex_;
  std::map<ExactPlaneKey, PlaneId> planes_;
  Solid out_;
};

}  // namespace

std::optional<Solid> take_out(const Solid& solid, const Segmentation& segmentation,
                              const VertexPool& vertices, std::span<const CellId> leaves,
                              double weld_m, Work& work) {
  const auto complex = body_without(solid, segmentation, vertices, leaves, work);
  if (!complex) return std::nullopt;
  Solid made = SolidOfFaces(solid, segmentation, *complex).run();
  if (made.facets.empty() || !is_closed(made) || volume_m3(made) <= 0 ||
      doubled_edges_of(made) > doubled_edges_of(solid) ||
      slivers_of(made, weld_m) > slivers_of(solid, weld_m))
    return std::nullopt;
  return made;
}

}  // namespace oriel::detail
