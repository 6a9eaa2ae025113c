#include "kernel/geometry/exact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <boost/multiprecision/cpp_int.hpp>

namespace oriel::exact {

namespace {

using Int256 = boost::multiprecision::int256_t;

Int128 absolute(Int128 value) { return value < 0 ? -value : value; }

std::int64_t gcd(std::int64_t p, std::int64_t q) { return std::gcd(p, q); }

Int128 gcd(Int128 p, Int128 q) {
  p = absolute(p);
  q = absolute(q);
  while (q != 0) {
    const Int128 rest = p % q;
    p = q;
    q = rest;
  }
  return p;
}

bool fits_in_64_bits(Int128 value) { return value == static_cast<std::int64_t>(value); }

/// std::llround without a call: what is cut off is exact in doubles of this size.
std::int64_t rounded(double value) {
  constexpr double kLimit = 1e15;
  if (!(std::abs(value) < kLimit)) return std::llround(value);
  const auto whole = static_cast<std::int64_t>(value);
  const double rest = value - static_cast<double>(whole);
  return whole + static_cast<std::int64_t>(rest >= 0.5) - static_cast<std::int64_t>(rest <= -0.5);
}

int sign_of(Int128 value) { return (value > 0) - (value < 0); }

/// numerator / denominator to about one bit: the integer part and the fraction are divided apart.
/// `Int` is the type to divide in; the result does not depend on it.
template <class Int>
double divide_as(Int numerator, Int denominator) {
  const Int whole = numerator / denominator;
  const Int rest = numerator % denominator;
  return static_cast<double>(whole) + static_cast<double>(static_cast<long double>(rest) /
                                                          static_cast<long double>(denominator));
}

double divide(Int128 numerator, Int128 denominator) {
  if (!fits_in_64_bits(numerator) || !fits_in_64_bits(denominator))
    return divide_as<Int128>(numerator, denominator);
  if (denominator == 1) return static_cast<double>(static_cast<std::int64_t>(numerator));
  return divide_as<std::int64_t>(static_cast<std::int64_t>(numerator),
                                 static_cast<std::int64_t>(denominator));
}

/// `vector` without its common divisor, in the integers `Int`; nothing for the zero vector.
template <class Int>
std::optional<std::array<Int, 3>> reduced(const std::array<Int, 3>& vector) {
  std::array<Int, 3> out = vector;
  Int divisor = 0;
  for (const Int component : out)
    if (component != 0) divisor = divisor == 0 ? component : gcd(divisor, component);
  if (divisor == 0) return std::nullopt;
  if (divisor < 0) divisor = -divisor;
  if (divisor != 1)
    for (Int& component : out) component /= divisor;
  return out;
}

/// A vector without common divisor as a normal: itself if it fits in kMaxNormal, else rounded to 28
/// bits.
template <class Int>
std::array<std::int64_t, 3> as_normal(const std::array<Int, 3>& vector) {
  std::array<std::int64_t, 3> normal{};
  const auto absolute_of = [](Int value) { return value < 0 ? -value : value; };
  const Int largest =
      std::max({absolute_of(vector[0]), absolute_of(vector[1]), absolute_of(vector[2])});
  if (largest <= kMaxNormal) {
    for (std::size_t i = 0; i < 3; ++i) normal[i] = static_cast<std::int64_t>(vector[i]);
    return normal;
  }
  for (std::size_t i = 0; i < 3; ++i)
    normal[i] =
        std::llround(static_cast<long double>(vector[i]) / static_cast<long double>(largest) *
                     static_cast<long double>(kMaxNormal));
  const std::int64_t common = std::gcd(std::gcd(normal[0], normal[1]), normal[2]);
  for (auto& component : normal) component /= common;
  return normal;
}

/// The meeting of three planes across the three axes, as most of a building's are: its coordinates
/// are their offsets. Nothing for other planes.
std::optional<Rational> meet_along_axes(const Plane& p, const Plane& q, const Plane& r) {
  std::array<Int128, 3> at{};
  unsigned found = 0;
  for (const Plane* plane : {&p, &q, &r}) {
    const auto& [x, y, z] = plane->coefficients;
    if ((x != 0) + (y != 0) + (z != 0) != 1) return std::nullopt;
    const std::size_t axis = x != 0 ? 0 : y != 0 ? 1 : 2;
    const std::int64_t sign = x + y + z;
    if (sign != 1 && sign != -1) return std::nullopt;
    at[axis] = sign * Int128{plane->offset};
    found |= 1U << axis;
  }
  constexpr unsigned kAll = 7;
  if (found != kAll) return std::nullopt;
  return Rational{at[0], at[1], at[2], 1};
}

}  // namespace

GridPoint round_to_grid(Vec3 point, double grid_m) {
  return {rounded(point.x / grid_m), rounded(point.y / grid_m), rounded(point.z / grid_m)};
}

Rational round_finely(Vec3 point, double grid_m) {
  constexpr std::int64_t kFiner = std::int64_t{1} << 20;
  const GridPoint fine = round_to_grid(point, grid_m / kFiner);
  return {fine[0], fine[1], fine[2], kFiner};
}

Vec3 to_metres(const GridPoint& point, double grid_m) {
  return {static_cast<double>(point[0]) * grid_m, static_cast<double>(point[1]) * grid_m,
          static_cast<double>(point[2]) * grid_m};
}

Vec3 on_grid(Vec3 point, double grid_m) { return to_metres(round_to_grid(point, grid_m), grid_m); }

Vec3 to_metres(const Rational& point, double grid_m) {
  return {divide(point.x, point.w) * grid_m, divide(point.y, point.w) * grid_m,
          divide(point.z, point.w) * grid_m};
}

std::optional<std::array<std::int64_t, 3>> direction(const std::array<std::int64_t, 3>& vector) {
  // Most vectors of a building are along an axis.
  if ((vector[0] != 0) + (vector[1] != 0) + (vector[2] != 0) == 1)
    return std::array<std::int64_t, 3>{sign_of(vector[0]), sign_of(vector[1]), sign_of(vector[2])};
  const auto without_divisor = reduced(vector);
  return without_divisor ? std::optional(as_normal(*without_divisor)) : std::nullopt;
}

std::optional<std::array<std::int64_t, 3>> direction(const Vector128& vector) {
  // Dividing 128 bits is slow, and all but the largest polygons fit in 64.
  constexpr Int128 kLimit = std::numeric_limits<std::int64_t>::max();
  if (std::ranges::all_of(vector, [](Int128 c) { return c >= -kLimit && c <= kLimit; }))
    return direction(std::array{static_cast<std::int64_t>(vector[0]),
                                static_cast<std::int64_t>(vector[1]),
                                static_cast<std::int64_t>(vector[2])});
  return as_normal(*reduced(vector));
}

Int128 dot(const std::array<std::int64_t, 3>& normal, const GridPoint& point) {
  return Int128{normal[0]} * point[0] + Int128{normal[1]} * point[1] + Int128{normal[2]} * point[2];
}

Plane make_plane(const std::array<std::int64_t, 3>& normal, std::int64_t offset, double grid_m) {
  const Vec3 direction{static_cast<double>(normal[0]), static_cast<double>(normal[1]),
                       static_cast<double>(normal[2])};
  const double size = length(direction);
  return {normal, offset, (1 / size) * direction, static_cast<double>(offset) / size * grid_m};
}

Plane opposite(const Plane& plane) {
  return {{-plane.coefficients[0], -plane.coefficients[1], -plane.coefficients[2]},
          -plane.offset,
          -plane.normal,
          0 - plane.offset_m};
}

std::optional<Rational> meet(const Plane& p, const Plane& q, const Plane& r) {
  if (const auto corner = meet_along_axes(p, q, r)) return corner;
  // A minor is below 2^57 and so is its offset's product below 2^120.
  const auto minor = [](const Plane& s, const Plane& t, std::size_t i, std::size_t j) {
    return s.coefficients[i] * t.coefficients[j] - s.coefficients[j] * t.coefficients[i];
  };
  const auto crossed = [&](const Plane& s, const Plane& t) {
    return std::array<std::int64_t, 3>{minor(s, t, 1, 2), minor(s, t, 2, 0), minor(s, t, 0, 1)};
  };
  const auto qr = crossed(q, r), rp = crossed(r, p), pq = crossed(p, q);
  Int128 w = Int128{qr[0]} * p.coefficients[0] + Int128{qr[1]} * p.coefficients[1] +
             Int128{qr[2]} * p.coefficients[2];
  if (w == 0) return std::nullopt;
  Vector128 point{};
  for (std::size_t i = 0; i < 3; ++i)
    point[i] = Int128{qr[i]} * p.offset + Int128{rp[i]} * q.offset + Int128{pq[i]} * r.offset;
  if (w < 0) {
    w = -w;
    for (auto& component : point) component = -component;
  }
  return Rational{point[0], point[1], point[2], w};
}

std::optional<GridPoint> as_grid_point(const Rational& point) {
  const Int128 limit = point.w * kMaxCoordinate;
  const auto fits = [limit](Int128 c) { return c >= -limit && c <= limit; };
  if (!fits(point.x) || !fits(point.y) || !fits(point.z)) return std::nullopt;
  if (point.w == 1)
    return GridPoint{static_cast<std::int64_t>(point.x), static_cast<std::int64_t>(point.y),
                     static_cast<std::int64_t>(point.z)};
  if (point.x % point.w != 0 || point.y % point.w != 0 || point.z % point.w != 0)
    return std::nullopt;
  return GridPoint{static_cast<std::int64_t>(point.x / point.w),
                   static_cast<std::int64_t>(point.y / point.w),
                   static_cast<std::int64_t>(point.z / point.w)};
}

int side(const Plane& plane, const GridPoint& point) {
  return sign_of(dot(plane.coefficients, point) - plane.offset);
}

int side(const Plane& plane, const Rational& point) {
  const Int256 value = Int256(point.x) * plane.coefficients[0] +
                       Int256(point.y) * plane.coefficients[1] +
                       Int256(point.z) * plane.coefficients[2] - Int256(point.w) * plane.offset;
  return value.sign();
}

}  // namespace oriel::exact
