#pragma once

#include "model/vec3.h"

#include <cstddef>
#include <string>
#include <vector>

namespace oriel {

/// Where a building's local coordinates stand in the input's: input = local + origin_m. The origin
/// is the minimum of the box of the building's own polygons, floored to whole metres, so that local
/// coordinates are small and exact.
struct Frame {
  Vec3 origin_m;
  /// The input's coordinate reference system as it was written there, or empty.
  std::string crs;
};

/// An input polygon. Ring 0 is the outer ring, counter-clockwise seen from outside the building;
/// further rings are holes, clockwise. Entries index Building::vertices; the first vertex is not
/// repeated.
struct Polygon {
  std::vector<std::vector<int>> rings;
  /// The polygon's number in reading order, counted over the whole chosen geometry from 0.
  int source = -1;
  /// Which solid of a MultiSolid or CompositeSolid; 0 otherwise.
  int body = 0;
  /// Which shell of its solid: 0 the exterior one, 1… cavities.
  int shell = 0;
  /// Semantic surface type, material or group in the input, or empty. It may delimit a feature,
  /// never name it.
  std::string hint;
};

/// A vertex that stood once more in a row, in a ring (index) of a polygon (index); reading dropped
/// the repetition.
struct RepeatedVertex {
  int polygon = 0;
  int ring = 0;
  int vertex = 0;
};

/// An object of the input that stands on a building and has a geometry of its own (a
/// BuildingInstallation), where its polygons were read with those of the building.
struct JoinedInstallation {
  std::string id;
  /// Its polygons in Building::polygons: from this one to that of the next one, or to the end.
  std::size_t first_polygon = 0;
  /// Vertices of Building::vertices from this one on are of it or of those after it only.
  std::size_t first_vertex = 0;
};

/// One building (or building part) as read: polygons of one geometry at one level of detail, and
/// of the installations that were joined to it.
struct Building {
  /// The CityObject's id, or the file's stem for formats without ids.
  std::string id;
  /// The chosen geometry's level of detail as written in the input ("2.2"), or empty.
  std::string lod;
  Frame frame;
  /// True if the input states a solid (closed shells), false for loose surfaces.
  bool is_solid = true;
  /// True if the parts of the geometry must hang together: CompositeSolid, CompositeSurface.
  bool is_composite = false;
  std::vector<Vec3> vertices;
  std::vector<Polygon> polygons;
  /// What reading dropped from the rings, one entry for each drop.
  std::vector<RepeatedVertex> repeats;
  /// Objects whose polygons stand behind the building's own (ReadOptions::joins_installations);
  /// they are of its last body.
  std::vector<JoinedInstallation> installations{};
};

/// The building with its own polygons and vertices only: the one that is read where installations
/// are not joined, bit for bit.
Building without_installations(Building building);

/// The frame of points given in the input's coordinates: origin = their minimum floored to whole
/// metres.
Frame frame_of(const std::vector<Vec3>& points, std::string crs);

}  // namespace oriel
