#pragma once

#include "model/solid.h"
#include "model/vec3.h"
#include "model/whole_point.h"

#include <array>
#include <cstdint>
#include <optional>

/// Exact integer geometry on the grid of a solid. Everything the kernel decides comes down to these
/// few functions: a plane from points, the meeting of three planes, the side of a point. Ranges:
/// |coordinate| ≤ 2^32 grid units, |normal component| ≤ 2^28, so every intermediate fits in 128
/// bits but the side of a rational point, which takes 256.
namespace oriel::exact {

__extension__ using Int128 = __int128;

/// The largest |component| of an integer normal.
inline constexpr std::int64_t kMaxNormal = std::int64_t{1} << 28;

/// The largest |coordinate| in grid units that the ranges above allow.
inline constexpr std::int64_t kMaxCoordinate = std::int64_t{1} << 32;

/// A point of the grid, in grid units.
using GridPoint = WholePoint<struct GridUnits>;

/// A rational point (x/w, y/w, z/w) in grid units, w > 0.
struct Rational {
  Int128 x = 0, y = 0, z = 0, w = 1;
};

/// The nearest grid point to a point in metres; `grid_m` is a power of two.
GridPoint round_to_grid(Vec3 point, double grid_m);

/// The nearest point of a grid 2^20 times finer: as near as doubles of a building's size are told
/// apart.
Rational round_finely(Vec3 point, double grid_m);

/// A grid point in metres: exact, as |coordinate| < 2^53.
Vec3 to_metres(const GridPoint& point, double grid_m);

/// The grid point nearest to a point, in metres: what readers of several formats make of one place
/// differs in the last digits, which this takes off.
Vec3 on_grid(Vec3 point, double grid_m);

/// A rational point in metres, correct to the last bit or so.
Vec3 to_metres(const Rational& point, double grid_m);

/// An exact vector: of a polygon's ring twice its area times its normal.
using Vector128 = std::array<Int128, 3>;

/// The direction of `vector` as an integer normal without common divisor: exact if it fits in
/// kMaxNormal, else rounded to 28 bits (2e-9 rad). Nothing for the zero vector.
std::optional<std::array<std::int64_t, 3>> direction(const Vector128& vector);
std::optional<std::array<std::int64_t, 3>> direction(const std::array<std::int64_t, 3>& vector);

/// normal · point.
Int128 dot(const std::array<std::int64_t, 3>& normal, const GridPoint& point);

/// The plane with that integer normal and offset, its doubles filled in.
Plane make_plane(const std::array<std::int64_t, 3>& normal, std::int64_t offset, double grid_m);

/// The plane with its orientation turned round.
Plane opposite(const Plane& plane);

/// Where three planes meet, or nothing if their normals are linearly dependent.
std::optional<Rational> meet(const Plane& p, const Plane& q, const Plane& r);

/// The point as a grid point if it is one.
std::optional<GridPoint> as_grid_point(const Rational& point);

/// +1 in front of the plane (where its normal points), 0 on it, -1 behind it.
int side(const Plane& plane, const GridPoint& point);
int side(const Plane& plane, const Rational& point);

}  // namespace oriel::exact
