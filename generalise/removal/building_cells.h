#pragma once

#include "kernel/base/work.h"
#include "kernel/geometry/outlines.h"
#include "kernel/segment/complex/vertex_pool.h"
#include "model/cell_complex.h"
#include "model/segmentation.h"
#include "model/solid.h"
#include "model/tolerances.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace oriel::detail {

/// Which cells of a complex hang together, by faces or edges.
class CellContacts {
 public:
  /// `cells`: how many the complex has.
  CellContacts(const CellComplex& complex, std::size_t cells);

  /// Counts the pieces that some cells are in; none of them counts as several.
  [[nodiscard]] int pieces_of(const std::vector<CellId>& some) const;

 private:
  std::size_t cells_;
  std::vector<std::vector<CellId>> touching_;  ///< at one edge, each set of them once
};

/// Finds again which input polygons a figure lies in. Refers to the solid, which must outlive it.
class PolygonsAround {
 public:
  /// Points up to `weld_m` off a plane are in it, as vertices may be.
  PolygonsAround(const Solid& solid, double weld_m);

  /// The input polygons of the facets of the solid that a figure in a plane lies in, whichever way
  /// they look; none if it is new. The plane is exact: those of a segmentation are its solid's.
  [[nodiscard]] std::set<int> of(const std::vector<Outline>& shape, const Plane& plane) const;

 private:
  const Solid& solid_;
  double weld_m_;
  std::map<std::array<std::int64_t, 3>, std::vector<FacetId>> facets_along_;  ///< by direction
};

/// Keeps the input polygons that faces of a complex lie in, each looked for once. Refers to all
/// that it is made of.
class FaceNames {
 public:
  FaceNames(const CellComplex& complex, const PolygonsAround& around,
            const Segmentation& segmentation)
      : complex_(complex), around_(around), segmentation_(segmentation) {}

  const std::vector<int>& of(FaceId id);

 private:
  const CellComplex& complex_;
  const PolygonsAround& around_;
  const Segmentation& segmentation_;
  std::map<FaceId, std::vector<int>> known_;
};

/// The cells of a solid that was segmented, and what is known of them: each thing is found when it
/// is first asked for, for all that is tried with the solid. Refers to both.
class BuildingCells {
 public:
  BuildingCells(const Solid& solid, const Segmentation& segmentation, const Tolerances& tolerances)
      : solid_(solid), segmentation_(segmentation), tolerances_(tolerances) {}

  const VertexPool& vertices();
  const PolygonsAround& polygons_around();
  /// The input polygons that the facets of the solid name.
  const std::set<int>& named();

  /// The complex; null if the work did not last for it.
  const CellComplex* complex(Work& work);
  /// What complex() made, or null.
  [[nodiscard]] const CellComplex* known_complex() const { return complex_ ? &*complex_ : nullptr; }
  /// These need a complex().
  const CellContacts& contacts();
  FaceNames& names();
  /// It tells all of the building.
  bool is_closed();

 private:
  const Solid& solid_;
  const Segmentation& segmentation_;
  Tolerances tolerances_;
  std::optional<VertexPool> vertices_{};
  std::optional<PolygonsAround> polygons_around_{};
  std::optional<std::set<int>> named_{};
  std::optional<CellComplex> complex_{};
  std::optional<CellContacts> contacts_{};
  std::optional<FaceNames> names_{};
  std::optional<bool> is_closed_{};
};

/// The solid without these leaves of the segmentation (body_without), in planes of the building:
/// what leaves do not touch stays as it is. Facets name no polygons. `solid` is the one that was
/// segmented, or another one in its planes that has the leaves.
///
/// Nothing if `work` is used up, if that is no closed solid, if it touches itself along more edges
/// than before, or if more facets are narrower than weld_m: where vertices lie off their planes
/// slivers come up, and the pieces have to be solidified anew.
std::optional<Solid> take_out(const Solid& solid, const Segmentation& segmentation,
                              const VertexPool& vertices, std::span<const CellId> leaves,
                              double weld_m, Work& work);

}  // namespace oriel::detail
