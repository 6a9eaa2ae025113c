#pragma once

#include "io/citygml/xml_node.h"
#include "model/vec3.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace oriel::detail {

/// A polygon of a GML geometry.
struct GmlPolygon {
  /// The element that states it. Geometries share a polygon by sharing its element.
  const XmlNode* node = nullptr;
  /// Numbers of vertices; the first is not repeated. Ring 0 is the outer ring.
  std::vector<std::vector<int>> rings;
};

/// A GML geometry: solids, their shells, their polygons; surfaces are one solid of one shell.
struct GmlGeometry {
  /// "Solid", "MultiSolid", "CompositeSolid" or "MultiSurface", as CityJSON calls it.
  std::string_view type;
  std::vector<std::vector<std::vector<GmlPolygon>>> bodies;
};

/// The vertices of a building: one for all positions that are the same micrometre.
class GmlVertices {
 public:
  /// Whole micrometres from the origin.
  using Position = std::array<std::int64_t, 3>;

  explicit GmlVertices(Vec3 origin) : origin_(origin) {}
  /// The number of the vertex at `point`, whose coordinates are finite and at most 1e9.
  int add(Vec3 point);
  [[nodiscard]] const std::vector<Position>& positions() const { return positions_; }

 private:
  struct Hash {
    std::size_t operator()(const Position& position) const noexcept;
  };

  Vec3 origin_;
  std::vector<Position> positions_;
  std::unordered_map<Position, int, Hash> number_of_;
};

/// The first position below `node`, floored to whole metres; zero if there is none.
Vec3 first_position(const XmlNode& node);

/// Reads the geometries of one building.
///
/// Read are Solid, MultiSolid and CompositeSolid; MultiSurface, CompositeSurface,
/// OrientableSurface, Surface, PolyhedralSurface, TriangulatedSurface, Tin, MultiGeometry and Shell
/// of them; Polygon, PolygonPatch, Triangle and Rectangle of LinearRings with posList, pos,
/// pointProperty or coordinates. A surface that is turned round (orientation "-") has its rings
/// turned round.
///
/// GML puts every geometry into a property. One that stands in another without a property, and a
/// property that stands directly in another, are read as if that were kept. Boundary surfaces in
/// the property of a geometry are passed over.
class GmlReader {
 public:
  /// `links` and `vertices` must outlive the reader.
  GmlReader(XmlLinks& links, GmlVertices& vertices) : links_(links), vertices_(vertices) {}

  /// The geometries in `property`, its solids as one and its surfaces as one; nothing if it is
  /// empty, or for a fault (then `fault()` has it):
  /// E201 a polygon without a ring, E204 an element that is no surface, E207 and E211 as XmlLinks,
  /// E210 coordinates that are not, E212 links in a circle, E503 nested too deep by way of links,
  /// E506.
  std::vector<GmlGeometry> read(const XmlNode& property);
  /// All polygons in `property`, of solids too.
  std::vector<GmlPolygon> read_polygons(const XmlNode& property);

  [[nodiscard]] const std::optional<NodeFault>& fault() const { return fault_; }
  /// The first ring that does not end where it began, or null. (It is read as if it did.)
  [[nodiscard]] const XmlNode* open_ring() const { return open_ring_; }

 private:
  using GmlShell = std::vector<GmlPolygon>;
  using Body = std::vector<GmlShell>;
  using Bodies = std::vector<Body>;
  /// What elements have from those around them.
  struct Context {
    bool is_turned = false;
    int dimension = 3;
  };

  bool read_solids(const XmlNode& node, Context context, Bodies& bodies);
  bool read_surfaces(const XmlNode& node, Context context, GmlShell& shell);
  bool read_polygon(const XmlNode& node, Context context, GmlShell& shell);
  bool read_rings(const XmlNode& node, Context context, std::vector<std::vector<int>>& rings);
  bool read_ring(const XmlNode& ring, Context context, std::vector<int>& vertices);
  bool read_positions(const XmlNode& node, Context context, std::vector<int>& vertices);
  /// True unless the value of `property` is one too many, too deep, or one that reading is in.
  bool may_visit(const XmlNode& property, const XmlNode& value);
  /// Calls `visit` with each value of `property`, up to the first fault; false if there is one. A
  /// geometry that stands where a property should is its own value.
  template <class Visit>
  bool for_each_value(const XmlNode& property, const Visit& visit);
  bool fail(const XmlNode& node, Code code, std::string sentence);

  XmlLinks& links_;
  GmlVertices& vertices_;
  std::unordered_map<const XmlNode*, std::vector<std::vector<int>>> rings_of_;
  /// The targets of the links that were followed to where reading stands.
  std::unordered_set<const XmlNode*> followed_;
  /// How many properties reading stands in.
  int depth_ = 0;
  /// How many values of properties were visited, those behind links counted each time.
  std::size_t visited_ = 0;
  std::optional<NodeFault> fault_;
  const XmlNode* open_ring_ = nullptr;
};

}  // namespace oriel::detail
