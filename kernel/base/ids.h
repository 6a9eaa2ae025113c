#pragma once

#include <compare>
#include <cstddef>
#include <functional>

namespace oriel {

/// An index with a kind: a PlaneId cannot be passed where a FeatureId is meant.
/// The default is invalid (-1). Ids order by value and are dense: id `k` is element `k` of its
/// list.
template <class Tag>
struct Id {
  int value = -1;

  [[nodiscard]] constexpr bool is_valid() const { return value >= 0; }
  [[nodiscard]] constexpr std::size_t index() const { return static_cast<std::size_t>(value); }
  friend constexpr auto operator<=>(Id, Id) = default;
};

/// An oriented plane of a solid: Solid::planes, Segmentation::planes.
using PlaneId = Id<struct PlaneTag>;
/// A facet of a solid: Solid::facets.
using FacetId = Id<struct FacetTag>;
/// A node of the CSG tree: Segmentation::nodes.
using NodeId = Id<struct NodeTag>;
/// A leaf of the CSG tree as a body: Segmentation::cells.
using CellId = Id<struct CellTag>;
/// A face of the cell complex: CellComplex::faces.
using FaceId = Id<struct FaceTag>;
/// A split-off part: Segmentation::features, and the rows of FeatureTable.
using FeatureId = Id<struct FeatureTag>;

}  // namespace oriel

template <class Tag>
struct std::hash<oriel::Id<Tag>> {
  std::size_t operator()(oriel::Id<Tag> id) const noexcept { return std::hash<int>{}(id.value); }
};
