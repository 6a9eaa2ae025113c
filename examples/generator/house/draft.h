#pragma once

#include "examples/generator/house/body.h"

#include <unordered_map>
#include <vector>

namespace oriel::generator {

/// A facet under construction. kNewFacet asks a building function to make one.
enum class FacetId : int {};
inline constexpr FacetId kNewFacet{-1};

/// A body under construction: facets that are formal sums of rings.
///
/// Solids are put together face by face: the face of an added block that lies in a facet is summed
/// into it. A ring with the facet's orientation adds area, one with the opposite orientation takes
/// area away, and edges that run along each other in opposite directions cancel when the draft is
/// closed. So a pocket in a wall, a door's notch in wall and ground, the U a balcony's parapet
/// leaves on the wall, and two boxes glued side by side are all the same operation.
class Draft {
 public:
  /// The new object's number. Its name is made from its class (or, for decor, its subclass) and an
  /// ordinal.
  int add_object(Object object);

  FacetId add_facet(Owner owner);
  /// Sums the ring into the facet, which is made first if it is kNewFacet. Equal neighbouring
  /// points are taken as one.
  FacetId add_ring(FacetId facet, Owner owner, const Ring& ring);
  void add_ring(FacetId facet, const Ring& ring);
  [[nodiscard]] Owner owner(FacetId facet) const {
    return facets_[static_cast<std::size_t>(facet)].owner;
  }

  /// The finished body: edges split where corners lie on them, opposite edges cancelled, vertices
  /// that nothing needs dropped, rings traced and sorted into polygons with holes. A facet that
  /// fell apart becomes several polygons. Whether the result is a solid is for find_faults to say.
  [[nodiscard]] Body close() const;

 private:
  struct Facet {
    Owner owner;
    std::vector<std::vector<int>> rings;
  };
  struct PointHash {
    std::size_t operator()(const Point& p) const {
      const auto mix = [](std::uint64_t h) { return (h ^ (h >> 32U)) * 0x9e3779b97f4a7c15U; };
      const auto bits = [](Um n) { return static_cast<std::uint64_t>(n); };
      return mix(mix(mix(bits(p.x)) + bits(p.y)) + bits(p.z));
    }
  };

  int vertex_at(Point point);

  std::vector<Point> points_;
  std::unordered_map<Point, int, PointHash> number_of_;
  std::vector<Facet> facets_;
  std::vector<Object> objects_;
  std::unordered_map<std::string, int> ordinals_;
};

}  // namespace oriel::generator
