#include "kernel/validate/solids/predicates.h"

#include "kernel/base/assert.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oriel::detail {

namespace {

using exact::Int128;

int sign(Int128 value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

std::array<std::int64_t, 3> between(const MicrometrePoint& a, const MicrometrePoint& b) {
  return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
}

exact::Vector128 cross_product(const std::array<std::int64_t, 3>& u,
                               const std::array<std::int64_t, 3>& v) {
  return {Int128{u[1]} * v[2] - Int128{u[2]} * v[1], Int128{u[2]} * v[0] - Int128{u[0]} * v[2],
          Int128{u[0]} * v[1] - Int128{u[1]} * v[0]};
}

/// The determinant of three vectors in doubles, and the sum of its products' sizes. Vectors of
/// whole numbers below 2^53 are exact in doubles, so that the error is below 8 ulp of that sum.
std::pair<double, double> determinant(const std::array<std::int64_t, 3>& u,
                                      const std::array<std::int64_t, 3>& v,
                                      const std::array<std::int64_t, 3>& w) {
  double value = 0;
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    const double p = static_cast<double>(u[j]) * static_cast<double>(v[k]);
    const double q = static_cast<double>(u[k]) * static_cast<double>(v[j]);
    const auto z = static_cast<double>(w[i]);
    value += (p - q) * z;
    size += (std::abs(p) + std::abs(q)) * std::abs(z);
  }
  return {value, size};
}

}  // namespace

int turn(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  return sign(Int128{b[0] - a[0]} * (c[1] - a[1]) - Int128{b[1] - a[1]} * (c[0] - a[0]));
}

bool is_on(const FlatPoint& p, const FlatPoint& a, const FlatPoint& b) {
  for (std::size_t i = 0; i < 2; ++i)
    if (p[i] < std::min(a[i], b[i]) || p[i] > std::max(a[i], b[i])) return false;
  return turn(a, b, p) == 0;
}

Meeting meeting(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c, const FlatPoint& d) {
  if (a == b) return is_on(a, c, d) ? Meeting::touch : Meeting::none;
  if (c == d) return is_on(c, a, b) ? Meeting::touch : Meeting::none;
  const int c_side = turn(a, b, c);
  const int d_side = turn(a, b, d);
  const int a_side = turn(c, d, a);
  const int b_side = turn(c, d, b);
  if (c_side * d_side < 0 && a_side * b_side < 0) return Meeting::cross;
  if (c_side == 0 && d_side == 0) {
    // On one line: compared by the axis along which it is longest.
    const auto along = [&](const FlatPoint& p) {
      const bool is_flat = std::abs(b[0] - a[0]) >= std::abs(b[1] - a[1]);
      return is_flat ? p[0] : p[1];
    };
    const auto from = std::max(std::min(along(a), along(b)), std::min(along(c), along(d)));
    const auto to = std::min(std::max(along(a), along(b)), std::max(along(c), along(d)));
    return from < to ? Meeting::overlap : from == to ? Meeting::touch : Meeting::none;
  }
  const bool is_touch = is_on(c, a, b) || is_on(d, a, b) || is_on(a, c, d) || is_on(b, c, d);
  return is_touch ? Meeting::touch : Meeting::none;
}

int side_of(const MicrometrePoint& a, const MicrometrePoint& b, const MicrometrePoint& c,
            const MicrometrePoint& d) {
  const auto u = between(a, b);
  const auto v = between(a, c);
  const auto w = between(a, d);
  const auto [value, size] = determinant(u, v, w);
  constexpr double kError = 8 * 2.220446049250313e-16;
  if (value > kError * size) return 1;
  if (value < -kError * size) return -1;
  const auto n = cross_product(u, v);
  return sign(n[0] * w[0] + n[1] * w[1] + n[2] * w[2]);
}

bool are_collinear(const MicrometrePoint& a, const MicrometrePoint& b, const MicrometrePoint& c) {
  return cross_product(between(a, b), between(a, c)) == exact::Vector128{};
}

std::size_t main_axis(const MicrometreTriangle& triangle) {
  auto n = cross_product(between(triangle[0], triangle[1]), between(triangle[0], triangle[2]));
  for (Int128& x : n) x = x < 0 ? -x : x;
  return static_cast<std::size_t>(std::ranges::max_element(n) - n.begin());
}

FlatPoint flattened(const MicrometrePoint& point, std::size_t axis, bool is_positive) {
  ORIEL_ASSERT(axis < 3);
  const std::int64_t x = point[(axis + 1) % 3];
  const std::int64_t y = point[(axis + 2) % 3];
  return is_positive ? FlatPoint{x, y} : FlatPoint{y, x};
}

namespace {

/// Of a segment in the triangle's plane.
bool meets_in_plane(const MicrometrePoint& p, const MicrometrePoint& q,
                    const MicrometreTriangle& triangle) {
  const std::size_t axis = main_axis(triangle);
  const auto flat = [axis](const MicrometrePoint& point) { return flattened(point, axis, true); };
  const std::array corners{flat(triangle[0]), flat(triangle[1]), flat(triangle[2])};
  const FlatPoint from = flat(p);
  bool is_left = true;
  bool is_right = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const FlatPoint& a = corners[i];
    const FlatPoint& b = corners[(i + 1) % 3];
    if (meeting(a, b, from, flat(q)) != Meeting::none) return true;
    is_left = is_left && turn(a, b, from) > 0;
    is_right = is_right && turn(a, b, from) < 0;
  }
  return is_left || is_right;
}

/// Signs of the line p, q against the triangle's edges: it goes through the triangle if none is of
/// the other sign.
std::array<int, 3> winding(const MicrometrePoint& p, const MicrometrePoint& q,
                           const MicrometreTriangle& t) {
  return {side_of(p, q, t[0], t[1]), side_of(p, q, t[1], t[2]), side_of(p, q, t[2], t[0])};
}

}  // namespace

bool meets(const MicrometrePoint& p, const MicrometrePoint& q, const MicrometreTriangle& t) {
  const int p_side = side_of(t[0], t[1], t[2], p);
  const int q_side = side_of(t[0], t[1], t[2], q);
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) return meets_in_plane(p, q, t);
  const auto signs = winding(p, q, t);
  const auto [least, most] = std::ranges::minmax(signs);
  return least >= 0 || most <= 0;
}

bool meet(const MicrometreTriangle& a, const MicrometreTriangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (meets(a[i], a[(i + 1) % 3], b)) return true;
    if (meets(b[i], b[(i + 1) % 3], a)) return true;
  }
  return false;
}

bool pierce(const MicrometreTriangle& a, const MicrometreTriangle& b) {
  const auto goes_through = [](const MicrometrePoint& p, const MicrometrePoint& q,
                               const MicrometreTriangle& t) {
    if (side_of(t[0], t[1], t[2], p) * side_of(t[0], t[1], t[2], q) >= 0) return false;
    const auto signs = winding(p, q, t);
    const auto [least, most] = std::ranges::minmax(signs);
    return least > 0 || most < 0;
  };
  for (std::size_t i = 0; i < 3; ++i)
    if (goes_through(a[i], a[(i + 1) % 3], b) || goes_through(b[i], b[(i + 1) % 3], a)) return true;
  return false;
}

}  // namespace oriel::detail
