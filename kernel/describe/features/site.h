#pragma once

#include "kernel/describe/features/shape.h"
#include "model/segmentation.h"

#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace oriel::detail {

/// The ground at the foot of a feature, and what told it: "facet", "wall" or "body".
struct Foot {
  double ground_m = 0;
  std::string source;
  CellId cell;  ///< whose facet it is
};

/// What the building around the features is: its ground, ridge and eaves, taken from the cells,
/// where every feature has been taken off and every hole is filled.
class Site {
 public:
  explicit Site(const Segmentation& segmentation);

  /// The ground at a point in plan: the lowest downward facet above or below it, the air under the
  /// body being filled but where the ground rises there. Failing that the
  /// foot of `wall`, failing that the lowest point of the building. Slopes and raised floors so
  /// keep their own ground.
  [[nodiscard]] Foot ground_at(Vec3 point, const std::optional<CellFacet>& wall) const;

  /// The highest point of the largest solid cell: the ridge of the main roof.
  [[nodiscard]] double ridge_m() const { return ridge_m_; }

  /// The lowest point of the roof facets of a cell: its eaves; nothing if it has no roof.
  [[nodiscard]] std::optional<double> eaves_m(CellId cell) const { return eaves_m_[cell.index()]; }

 private:
  struct GroundFacet {
    std::vector<std::vector<Vec3>> outlines;
    Box box;
    Plane plane;
    CellId cell;
  };
  void find_uncut();
  [[nodiscard]] bool is_uncut(const Facet& facet) const;
  void find_terrain();
  [[nodiscard]] GroundFacet ground_facet(CellFacet facet, const Plane& plane, CellId cell) const;
  static std::optional<Foot> lowest_at(Vec3 point, std::span<const GroundFacet> facets);

  const Segmentation& segmentation_;
  std::set<int> uncut_;  ///< Polygon::source
  std::vector<GroundFacet> grounds_;
  std::vector<GroundFacet> terrain_;  ///< undersides of the body over ground that rises
  std::vector<std::optional<double>> eaves_m_;
  double ridge_m_ = 0;
  double lowest_m_ = 0;
};

}  // namespace oriel::detail
