#include "generalise/removal/building_cells.h"

#include "generalise/invariants/stays.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/complex/body_without.h"
#include "kernel/segment/complex/cell_complex.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// The same for parallel planes.
std::array<std::int64_t, 3> direction_of(const Plane& plane) {
  return std::max(plane.coefficients, exact::opposite(plane).coefficients);
}

}  // namespace

CellContacts::CellContacts(const CellComplex& complex, std::size_t cells) : cells_(cells) {
  std::vector<std::tuple<int, int, CellId>> at_edge;
  for (const Face& face : complex.faces())
    for (const Loop& loop : face.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const auto [low, high] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
        for (const CellId cell : {face.behind, face.front})
          if (cell.is_valid()) at_edge.emplace_back(low, high, cell);
      }
  std::ranges::sort(at_edge);
  at_edge.erase(std::unique(at_edge.begin(), at_edge.end()), at_edge.end());
  for (std::size_t i = 0; i < at_edge.size();) {
    const auto [low, high, first] = at_edge[i];
    std::vector<CellId> there;
    for (; i < at_edge.size() &&
           std::tuple(std::get<0>(at_edge[i]), std::get<1>(at_edge[i])) == std::tuple(low, high);
         ++i)
      there.push_back(std::get<2>(at_edge[i]));
    touching_.push_back(std::move(there));
  }
  std::ranges::sort(touching_);
  touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
}

int CellContacts::pieces_of(const std::vector<CellId>& some) const {
  std::vector<char> is_there(cells_, 0), is_met(cells_, 0);
  for (const CellId cell : some) is_there[cell.index()] = 1;
  DisjointSets sets(cells_);
  for (const std::vector<CellId>& touching : touching_) {
    CellId before;
    for (const CellId cell : touching) {
      if (is_there[cell.index()] == 0) continue;
      is_met[cell.index()] = 1;
      if (before.is_valid()) sets.unite(before.value, cell.value);
      before = cell;
    }
  }
  int pieces = 0;
  for (std::size_t i = 0; i < cells_; ++i)
    pieces += is_met[i] != 0 && sets.find(static_cast<int>(i)) == static_cast<int>(i) ? 1 : 0;
  return pieces;
}

PolygonsAround::PolygonsAround(const Solid& solid, double weld_m) : solid_(solid), weld_m_(weld_m) {
  for (const FacetId f : ids_below<FacetId>(solid.facets.size()))
    facets_along_[direction_of(solid.planes[solid.facets[f.index()].plane.index()])].push_back(f);
}

std::set<int> PolygonsAround::of(const std::vector<Outline>& shape, const Plane& plane) const {
  const auto near = facets_along_.find(direction_of(plane));
  if (near == facets_along_.end()) return {};
  const auto point = interior_point(shape, plane.normal);
  if (!point) return {};
  std::set<int> polygons;
  for (const FacetId f : near->second) {
    const Facet& facet = solid_.facets[f.index()];
    const Plane& its = solid_.planes[facet.plane.index()];
    const bool is_same = its.coefficients == plane.coefficients ? its.offset == plane.offset
                                                                : its.offset == -plane.offset;
    const bool is_in_plane = is_same || std::abs(dot(its.normal, *point) - its.offset_m) <= weld_m_;
    if (!is_in_plane) continue;
    if (contains(outlines_of(solid_.vertices, facet.loops), its.normal, *point))
      polygons.insert(facet.polygons.begin(), facet.polygons.end());
  }
  return polygons;
}

const std::vector<int>& FaceNames::of(FaceId id) {
  const auto [entry, is_new] = known_.try_emplace(id);
  if (!is_new) return entry->second;
  const Face& face = complex_.face(id);
  const auto found = around_.of(outlines_of(complex_.vertices(), face.loops),
                                segmentation_.planes[face.plane.index()]);
  return entry->second = {found.begin(), found.end()};
}

const VertexPool& BuildingCells::vertices() {
  if (!vertices_) vertices_ = vertices_of(segmentation_, tolerances_);
  return *vertices_;
}

const PolygonsAround& BuildingCells::polygons_around() {
  if (!polygons_around_) polygons_around_.emplace(solid_, tolerances_.weld_m);
  return *polygons_around_;
}

const std::set<int>& BuildingCells::named() {
  if (!named_) named_ = polygons_named(solid_);
  return *named_;
}

const CellComplex* BuildingCells::complex(Work& work) {
  if (!complex_) complex_ = cell_complex(segmentation_, tolerances_, work);
  return known_complex();
}

const CellContacts& BuildingCells::contacts() {
  if (!contacts_) contacts_.emplace(*complex_, segmentation_.cells.size());
  return *contacts_;
}

FaceNames& BuildingCells::names() {
  if (!names_) names_.emplace(*complex_, polygons_around(), segmentation_);
  return *names_;
}

bool BuildingCells::is_closed() {
  if (!is_closed_) is_closed_ = complex_->open_edge_count() == 0;
  return *is_closed_;
}

}  // namespace oriel::detail
