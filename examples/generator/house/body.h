#pragma once

#include "examples/generator/geometry/point.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::generator {

/// The label vocabulary. `ground` and every decor are written as class "other" with a subclass.
enum class Class {
  window,
  door,
  chimney,
  vent,
  dormer,
  balcony,
  loggia,
  bay,
  canopy,
  stairs,
  other,
  wall,
  roof,
  ground,
};
inline constexpr int kClasses = 14;

/// The class's name in a truth file ("window"; "other" for ground).
std::string_view name_of(Class kind);
/// The class of the vocabulary that may be added under that name: none of the bare house's.
std::optional<Class> class_named(std::string_view name);
/// True for a window or a door.
constexpr bool is_opening(Class kind) { return kind == Class::window || kind == Class::door; }
/// True for the surfaces of the bare house: wall, roof, ground.
constexpr bool is_surface(Class kind) {
  return kind == Class::wall || kind == Class::roof || kind == Class::ground;
}

/// One thing of the ground truth. Objects are numbered from 0 in the order in which they were made.
struct Object {
  Class kind = Class::other;
  /// A finer kind such as "roofWindow" or "sill"; never empty.
  std::string subclass;
  /// The object whose surface this one stands on or is cut into; -1 for wall, roof and ground.
  int host = -1;
  /// The installation this one is part of (a dormer's window), else -1.
  int parent = -1;
  /// Openings only: how far the deepest pane lies behind its host's surface; 0 = flush.
  std::optional<Um> recess;
  /// Name that is unique in its building, such as "window_3".
  std::string name;
  /// A class that the vocabulary does not have (`--add`), in place of `kind`; else empty.
  std::string given_class = {};

  /// The class's name in a truth file.
  [[nodiscard]] std::string_view label() const;
};

/// Whose face a polygon is. A niche is the rim between an opening's pane and the wall around it.
struct Owner {
  int object = -1;
  bool is_niche = false;
};

/// A planar face of the body. Ring 0 is the outer ring, counter-clockwise seen from outside;
/// further rings are holes, clockwise. Entries index Body::vertices.
struct Polygon {
  Owner owner;
  std::vector<std::vector<int>> rings;
};

/// One closed solid with its ground truth; micrometres, ground at z = 0.
struct Body {
  std::vector<Point> vertices;
  std::vector<Polygon> polygons;
  std::vector<Object> objects;
  /// "flat", "gable", "hip" or "shed".
  std::string roof;
  int storeys = 0;
  /// The positions in Options::additions of what found no room.
  std::vector<int> without_room = {};
};

/// An axis-parallel box; the default is empty and grows to the points it is given.
struct Extent {
  static constexpr Um kFar = std::numeric_limits<Um>::max() / 4;
  Point low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};

  void grow(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  [[nodiscard]] Extent moved(Point by) const { return {low + by, high + by}; }
  [[nodiscard]] Extent grown(Um by) const {
    const Point all{by, by, by};
    return {low - all, high + all};
  }
  /// True if the two share more than a side.
  [[nodiscard]] bool overlaps(const Extent& other) const {
    return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
           other.low.y < high.y && low.z < other.high.z && other.low.z < high.z;
  }
};

Extent extent_of(const std::vector<Point>& points);

/// Twice the area of the polygon times its unit normal, in square metres.
Vec3 doubled_area(const Body& body, const Polygon& polygon);
Vec3 doubled_area(const Body& body, const std::vector<int>& ring);
/// The body's volume in cubic metres; positive if the normals point outwards.
double volume_m3(const Body& body);

}  // namespace oriel::generator
