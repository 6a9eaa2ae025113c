#pragma once

#include "kernel/geometry/exact.h"
#include "model/vec3.h"
#include "model/whole_point.h"

#include <array>
#include <cstddef>
#include <span>

/// Exact answers about points with whole coordinates, |coordinate| ≤ 2^32: every determinant fits
/// in 128 bits, and most signs are had from doubles with an error bound.
namespace oriel::detail {

using MicrometreTriangle = std::array<MicrometrePoint, 3>;

/// The box of points, in micrometres: exact, as doubles hold such coordinates.
inline Box box_of(std::span<const MicrometrePoint> points) {
  Box box;
  for (const MicrometrePoint& p : points)
    box.grow(Vec3{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
  return box;
}

/// A point of a plane seen along an axis.
using FlatPoint = std::array<std::int64_t, 2>;

/// +1 if a, b, c turn left, -1 right, 0 if they are on a line.
int turn(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c);

/// True if p is on the closed segment from a to b.
bool is_on(const FlatPoint& p, const FlatPoint& a, const FlatPoint& b);

/// How two closed segments meet.
enum class Meeting {
  none,
  /// In one point, which is an end of at least one of them.
  touch,
  /// In one point inside both.
  cross,
  /// In more than one point.
  overlap
};
Meeting meeting(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c, const FlatPoint& d);

/// +1 if d is in front of the triangle a, b, c (where it is seen counter-clockwise), -1 behind, 0
/// on its plane.
int side_of(const MicrometrePoint& a, const MicrometrePoint& b, const MicrometrePoint& c,
            const MicrometrePoint& d);

/// True if a, b, c are on a line.
bool are_collinear(const MicrometrePoint& a, const MicrometrePoint& b, const MicrometrePoint& c);

/// The axis along which the normal of the triangle is largest: 0, 1, 2. It must not be collinear.
std::size_t main_axis(const MicrometreTriangle& triangle);

/// `point` seen along `axis`; orientation is kept if `is_positive`, else turned.
FlatPoint flattened(const MicrometrePoint& point, std::size_t axis, bool is_positive);

/// True if the closed segment and the closed triangle, which must not be collinear, have a point in
/// common.
bool meets(const MicrometrePoint& p, const MicrometrePoint& q, const MicrometreTriangle& triangle);

/// True if the closed triangles have a point in common.
bool meet(const MicrometreTriangle& a, const MicrometreTriangle& b);

/// True if a segment inside both triangles, not in one plane, is where they meet: each then has
/// parts on both sides of the other.
bool pierce(const MicrometreTriangle& a, const MicrometreTriangle& b);

}  // namespace oriel::detail
