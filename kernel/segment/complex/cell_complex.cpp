#include "kernel/segment/complex/cell_complex.h"

#include "kernel/geometry/boxes.h"
#include "kernel/segment/complex/outlines.h"
#include "kernel/segment/complex/owners.h"
#include "kernel/segment/complex/sheet.h"
#include "kernel/segment/complex/vertex_pool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace oriel {

namespace {

/// Points nearer than this part of weld_m are one.
constexpr double kReach = 0.25;

/// What cutting a chord where others meet it takes, and again what an edge of a face takes.
constexpr std::int64_t kStepsPerChord = 192;

/// How far the box reaches to either side of the plane.
bool box_passes(const Box& box, const Plane& plane) {
  const Vec3 middle = 0.5 * (box.min + box.max), half = 0.5 * (box.max - box.min);
  const Vec3& n = plane.normal;
  const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
  return std::abs(dot(n, middle) - plane.offset_m) < reach;
}

std::vector<std::vector<Facet>> facets_of_cells(const Segmentation& segmentation) {
  std::vector<std::vector<Facet>> facets;
  facets.reserve(segmentation.cells.size());
  for (const Cell& cell : segmentation.cells) facets.push_back(cell.facets);
  return facets;
}

class ComplexBuilder {
 public:
  ComplexBuilder(const Segmentation& segmentation, const Tolerances& tolerances)
      : segmentation_(segmentation),
        pool_(segmentation.vertices, tolerances.weld_m * kReach),
        sheet_of_(detail::sheets_of(segmentation.planes)),
        facets_of_(detail::whole_outlines(facets_of_cells(segmentation), sheet_of_, pool_)),
        owners_(segmentation),
        vertices_of_cell_(segmentation.cells.size()),
        box_of_cell_(segmentation.cells.size()),
        is_on_(segmentation.vertices.size(), 0) {
    for (int c = 0; c < std::ssize(segmentation.cells); ++c) add_cell({c});
  }

  std::optional<CellComplex> build(Work& work) {
    std::vector<Face> faces;
    for (const auto& [plane, facets] : facets_in_) {
      for (Face& face : faces_in(plane, facets, work)) faces.push_back(std::move(face));
      if (work.is_used_up()) return std::nullopt;
    }
    detail::conform(faces, pool_.vertices(), pool_.reach_m() / 2);
    for (Face& face : faces) {
      const Vec3 normal = segmentation_.planes[face.plane.index()].normal;
      for (const Loop& loop : face.loops)
        face.area_m2 += signed_area_m2(pool_.vertices(), loop, normal);
    }
    return CellComplex(pool_.take(), std::move(faces), segmentation_.cells.size());
  }

 private:
  void add_cell(CellId id) {
    std::vector<int>& vertices = vertices_of_cell_[id.index()];
    const std::vector<Facet>& facets = facets_of_[id.index()];
    for (int f = 0; f < std::ssize(facets); ++f) {
      const Facet& facet = facets[static_cast<std::size_t>(f)];
      facets_in_[sheet_of_[facet.plane.index()]].push_back({id, f});
      for (const Loop& loop : facet.loops)
        vertices.insert(vertices.end(), loop.begin(), loop.end());
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const int v : vertices) box_of_cell_[id.index()].grow(pool_.at(v));
  }

  [[nodiscard]] const Facet& facet(CellFacet at) const {
    return facets_of_[at.cell.index()][static_cast<std::size_t>(at.facet)];
  }

  /// Which vertices lie in a sheet: those of its facets, whatever their coordinates.
  void mark(const std::vector<CellFacet>& facets, char is_on) {
    for (const CellFacet at : facets)
      for (const Loop& loop : facet(at).loops)
        for (const int v : loop) is_on_[static_cast<std::size_t>(v)] = is_on;
  }

  std::vector<Face> faces_in(PlaneId plane, const std::vector<CellFacet>& facets, Work& work) {
    mark(facets, 1);
    Box box;
    for (const CellFacet at : facets)
      for (const int v : facet(at).loops[0]) box.grow(pool_.at(v));
    std::vector<Chord> chords;
    detail::Slicer slicer(segmentation_.planes, plane, is_on_, pool_);
    // Cells that pass through the plane count where they are, on the plane's facets or not.
    std::vector<char> passes(segmentation_.cells.size(), 0);
    for (int c = 0; c < std::ssize(segmentation_.cells); ++c) {
      const auto i = static_cast<std::size_t>(c);
      if (!overlap(box_of_cell_[i], box, pool_.reach_m())) continue;
      if (!box_passes(box_of_cell_[i], segmentation_.planes[plane.index()])) continue;
      work.add(std::ssize(vertices_of_cell_[i]));
      passes[i] = slicer.passes(vertices_of_cell_[i]) ? 1 : 0;
      if (passes[i] != 0) slicer.add_sections({c}, facets_of_[i], chords);
    }
    for (const CellFacet at : facets)
      if (passes[at.cell.index()] == 0) slicer.add_facet(at.cell, facet(at), chords);
    mark(facets, 0);
    const Vec3 normal = segmentation_.planes[plane.index()].normal;
    work.add(std::ssize(segmentation_.cells) + kStepsPerChord * std::ssize(chords));
    if (work.is_used_up()) return {};
    std::vector<Face> faces =
        faces_of_sheet(plane, normal, std::move(chords), owners_, pool_, work);
    for (const Face& face : faces)
      for (const Loop& loop : face.loops) work.add(kStepsPerChord * std::ssize(loop));
    return faces;
  }

  const Segmentation& segmentation_;
  VertexPool pool_;
  std::vector<PlaneId> sheet_of_;
  std::vector<std::vector<Facet>> facets_of_;  ///< by cell
  detail::Owners owners_;
  std::map<PlaneId, std::vector<CellFacet>> facets_in_;
  std::vector<std::vector<int>> vertices_of_cell_;
  std::vector<Box> box_of_cell_;
  std::vector<char> is_on_;
};

}  // namespace

CellComplex cell_complex(const Segmentation& segmentation, const Tolerances& tolerances) {
  Work uncounted;
  return *ComplexBuilder(segmentation, tolerances).build(uncounted);
}

std::optional<CellComplex> cell_complex(const Segmentation& segmentation,
                                        const Tolerances& tolerances, Work& work) {
  return ComplexBuilder(segmentation, tolerances).build(work);
}

}  // namespace oriel
