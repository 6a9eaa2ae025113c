#pragma once

#include "kernel/segment/boundary/boundary.h"
#include "kernel/segment/planes/planes.h"
#include "kernel/segment/planes/points.h"
#include "model/building.h"
#include "model/segmentation.h"
#include "model/solid.h"
#include "model/vec3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

/// How a pocket is another one, the model, moved by a whole number of grid units: so every answer
/// about the one is that about the other.
struct Congruence {
  std::array<std::int64_t, 3> shift{};  ///< in grid units
  Vec3 shift_m;
  std::vector<std::pair<PointId, PointId>> points;   ///< of the model, of the other
  NumberMap planes;                                  ///< likewise
  std::vector<std::pair<FacetId, FacetId>> sources;  ///< of their facets, likewise
};

/// A convex body that is told to be a leaf before it is made: all that its cell is written from.
struct PocketLeaf {
  struct LeafFace {
    PlaneSide side;
    Loop loop;
  };
  std::vector<LeafFace> faces;
  /// Facets of the solid that faces are made of, face by face.
  struct LeafSource {
    FacetId source;
    int face;
  };
  std::vector<LeafSource> sources;
  double volume = 0;
};

/// Writes the leaves into the segmentation: their boundaries as cells, and which feature and which
/// input polygon ended up where.
class CellWriter {
 public:
  /// `facets`: how many the solid has.
  CellWriter(std::size_t facets, World& world, Segmentation& out)
      : world_(world), out_(out), made_of_(facets) {}

  /// The id of an oriented plane; planes that only caps of parts have are added behind the solid's.
  PlaneId plane_id(PlaneSide side);

  /// Adds a leaf that lies in `feature` (invalid: in no feature).
  CellId add(const Boundary& body, NodeId node, int sign, bool is_convex, LeafFlag flag,
             FeatureId feature);
  CellId add(PocketLeaf leaf, NodeId node, int sign, FeatureId feature);

  /// The side that such an id stands for.
  [[nodiscard]] PlaneSide side_of(PlaneId id) const;

  /// The cells from `first` up to `last` were copied, to where `copies` begins: what is made of a
  /// facet of the solid among them has a copy made of the facet that `sources` says.
  void copy_sources(std::span<const std::pair<FacetId, FacetId>> sources, CellId first, CellId last,
                    int copies);

  /// The feature is what a cut left beside nearly all of its body: a slab under which a house
  /// hangs.
  void add_rest(FeatureId feature) { rests_.push_back(feature); }

  /// Copies the points, and fills in what can be said only now that all leaves are there: hosts of
  /// features, polygons of facets and features.
  void finish(const Building& building, const Solid& solid);

 private:
  /// The outlines of a cell facet.
  struct FacetShape {
    boost::container::small_vector<Outline, 1> outlines;
    Box box;
  };
  /// The features that polygons of a cell of `innermost` are in; valid until the next call.
  const std::vector<FeatureId>& features_around(FeatureId innermost);
  /// To a cell facet, and to the features it is in.
  void give(std::span<const int> polygons, const CellFacet& home);
  void take_in_hosted();
  [[nodiscard]] double reach_m(const Feature& feature) const;
  void attribute_polygons(const Building& building, const Solid& solid);
  [[nodiscard]] std::vector<FacetShape> shapes_of(std::span<const CellFacet> cell_facets) const;
  [[nodiscard]] std::size_t home_of(const Building& building, const Polygon& polygon,
                                    std::span<const FacetShape> shapes, Vec3 normal) const;

  World& world_;
  Segmentation& out_;
  std::vector<PlaneId> extra_planes_;   ///< by side
  std::vector<PlaneSide> extra_sides_;  ///< in the order of their ids
  FeatureId innermost_;                 ///< that was asked for last, and what it is in
  std::vector<FeatureId> around_;
  std::vector<FeatureId> rests_;
  /// The cell facets made of each facet of the solid.
  IndexedVector<FacetId, boost::container::small_vector<CellFacet, 2>> made_of_;
};

}  // namespace oriel::detail
