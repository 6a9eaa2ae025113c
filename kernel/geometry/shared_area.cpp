#include "kernel/geometry/shared_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace oriel {

namespace {

struct FanPoint {
  double x = 0, y = 0;
};

/// One triangle of the fan of an outline, counter-clockwise; it counts once or is taken off.
struct FanTriangle {
  std::array<FanPoint, 3> corners;
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  bool is_taken_off = false;
};

double doubled_area(FanPoint a, FanPoint b, FanPoint c) {
  return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

/// The triangles that the edges of the outlines make with the first point of each: signed, they add
/// up to the figure, whatever its shape.
std::vector<FanTriangle> fans_of(std::span<const Outline> figure, const ReachAxes& axes) {
  std::vector<FanTriangle> out;
  for (const Outline& outline : figure) {
    std::vector<FanPoint> flat;
    for (const Vec3 p : outline) flat.push_back({dot(p, axes.u), dot(p, axes.v)});
    for (std::size_t i = 1; i + 1 < flat.size(); ++i) {
      FanTriangle t{{flat[0], flat[i], flat[i + 1]}};
      const double area = doubled_area(t.corners[0], t.corners[1], t.corners[2]);
      if (area == 0) continue;
      t.is_taken_off = area < 0;
      if (t.is_taken_off) std::swap(t.corners[1], t.corners[2]);
      const auto [x0, x1] = std::minmax({flat[0].x, flat[i].x, flat[i + 1].x});
      const auto [y0, y1] = std::minmax({flat[0].y, flat[i].y, flat[i + 1].y});
      t.x0 = x0, t.x1 = x1, t.y0 = y0, t.y1 = y1;
      out.push_back(t);
    }
  }
  return out;
}

bool may_meet(const FanTriangle& p, const FanTriangle& q) {
  return p.x0 < q.x1 && q.x0 < p.x1 && p.y0 < q.y1 && q.y0 < p.y1;
}

/// A convex piece that is cut from a triangle has six corners at most.
struct ConvexPiece {
  std::array<FanPoint, 8> corners;
  std::size_t size = 0;

  void add(FanPoint p) { corners[size++] = p; }
};

/// The part to the left of a → b (Sutherland and Hodgman).
ConvexPiece left_of(const ConvexPiece& piece, FanPoint a, FanPoint b) {
  ConvexPiece out;
  for (std::size_t i = 0; i < piece.size; ++i) {
    const FanPoint p = piece.corners[i], q = piece.corners[(i + 1) % piece.size];
    const double of_p = doubled_area(a, b, p), of_q = doubled_area(a, b, q);
    if (of_p >= 0) out.add(p);
    if ((of_p > 0 && of_q < 0) || (of_p < 0 && of_q > 0)) {
      const double t = of_p / (of_p - of_q);
      out.add({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
  }
  return out;
}

double shared_m2_of(const FanTriangle& p, const FanTriangle& q) {
  ConvexPiece piece;
  for (const FanPoint corner : p.corners) piece.add(corner);
  for (std::size_t k = 0; k < 3 && piece.size > 2; ++k)
    piece = left_of(piece, q.corners[k], q.corners[(k + 1) % 3]);
  double sum = 0;
  for (std::size_t i = 1; i + 1 < piece.size; ++i)
    sum += doubled_area(piece.corners[0], piece.corners[i], piece.corners[i + 1]);
  return sum / 2;
}

}  // namespace

double shared_area_m2(std::span<const Outline> one, std::span<const Outline> other, Vec3 normal) {
  const ReachAxes axes = axes_in(normal);
  const std::vector<FanTriangle> of_other = fans_of(other, axes);
  double sum_m2 = 0;
  for (const FanTriangle& p : fans_of(one, axes))
    for (const FanTriangle& q : of_other) {
      if (!may_meet(p, q)) continue;
      const double shared_m2 = shared_m2_of(p, q);
      sum_m2 += p.is_taken_off == q.is_taken_off ? shared_m2 : -shared_m2;
    }
  return std::abs(sum_m2);
}

double figure_area_m2(std::span<const Outline> figure, Vec3 normal) {
  double sum_m2 = 0;
  for (const Outline& outline : figure) sum_m2 += signed_area(outline, normal);
  return sum_m2;
}

}  // namespace oriel
