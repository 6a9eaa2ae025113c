#pragma once

#include "io/cityjson/cityjson_source.h"
#include "io/json/dom.h"
#include "io/json/plain_arrays.h"
#include "io/json/text.h"
#include "model/building.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace oriel::detail {

/// How a geometry type nests its polygons.
struct GeometryKind {
  /// Levels of arrays above the list of surfaces: 0 MultiSurface, 1 Solid (shells), 2 MultiSolid
  /// (solids, shells).
  int depth = 0;
  bool is_solid = false;
  /// Its parts must hang together.
  bool is_composite = false;
  /// The type.
  std::string_view name{};
};

/// The kind of a type that is read: MultiSurface, CompositeSurface, Solid, MultiSolid,
/// CompositeSolid. Nothing for others.
std::optional<GeometryKind> kind_of_geometry(std::string_view type);

/// The array for which `element` stands in PlainArrays::rest.
std::size_t number_of_array(dom::element element);

/// Turns geometries of one file into polygons of buildings.
class GeometryReader {
 public:
  /// `stored` are the file's vertices as they stand there (whole numbers, NaN where the file has
  /// none); it and `transform` must outlive the reader.
  GeometryReader(const std::vector<Vec3>& stored, const Transform& transform);

  /// The geometries that follow are of PlainArrays::rest; `text` is what `plain` has read. Both
  /// must outlive their reading. Null: they are as they stand in the text.
  void use(const PlainArrays* plain, std::string_view text);

  /// Fills the frame, solidity, vertices and polygons of `building` from a geometry of a kind that
  /// is read. Local coordinates are (translate - origin) + scale × integer, so that they keep the
  /// integer's digits. Says what is wrong, if anything: E201, E202, E203, E313, E501, E506.
  std::optional<Fault> read(dom::object geometry, GeometryKind kind, Building& building);

  /// Adds the polygons of another geometry of the same file to `building`, the last that was read
  /// or added to, as part of its last body. Its frame and its vertices stay, further vertices
  /// stand behind them. If something is wrong `building` stays as it is.
  std::optional<Fault> add(dom::object geometry, GeometryKind kind, Building& building);

  /// What was odd in the last geometry: E201, E208, E311, E312, E313.
  [[nodiscard]] const std::vector<Fault>& warnings() const { return warnings_; }

 private:
  bool read_boundaries(dom::element boundaries, GeometryKind kind);
  bool read_plain(const NestedNumbers& nested);
  bool read_bodies(dom::element boundaries, GeometryKind kind);
  bool read_shells(dom::element body);
  bool read_surfaces(dom::element shell);
  bool read_ring(dom::element element);
  int local_vertex(std::int64_t number);
  int new_vertex(std::int64_t number);
  Polygon& begin_polygon();
  void append_ring(std::vector<int> ring);
  [[nodiscard]] std::vector<Vec3> points() const;
  bool place_vertices(Building& building);
  void append_vertices(Building& building) const;
  void read_hints(dom::object semantics, GeometryKind kind);
  bool flatten(std::size_t begin, std::size_t end, const std::optional<dom::element>& values,
               int depth, const std::vector<std::string_view>& types);
  bool fail(Code code, std::string sentence);

  const std::vector<Vec3>& stored_;
  const Transform& transform_;
  const PlainArrays* plain_ = nullptr;
  std::string_view text_;
  /// Of boundaries that are plain, but not as deep as their geometry has to be.
  dom::parser parser_;
  /// The building's vertex for each of the file's, -1 where it has none yet.
  std::vector<int> local_of_;
  /// The file's vertex for each of the building's.
  std::vector<std::size_t> used_;
  std::vector<Polygon> polygons_;
  int body_ = 0;
  int shell_ = 0;
  /// Of each shell the end of its polygons, of each solid the end of its shells.
  std::array<std::vector<int>, 2> ends_;
  std::vector<RepeatedVertex> repeats_;
  /// Polygons whose outer ring is empty though there are holes, and those of no ring at all.
  std::vector<int> without_outer_;
  std::optional<Fault> fault_;
  std::vector<Fault> warnings_;
};

}  // namespace oriel::detail
