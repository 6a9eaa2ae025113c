// CGAL: exact predicates. On which side of a line (or plane) a point lies is decided exactly,
// though coordinates are doubles. Trap: the same determinant computed in doubles has wrong signs
// near zero. Trap: CGAL's kernel headers cost seconds of compile time (keep them out of headers),
// and NDEBUG switches CGAL's own checks off: check input at your own edge.
#include <cstdio>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;

/// The side of a → b on which p lies, computed in doubles: 1 left, -1 right, 0 on the line.
int side_in_doubles(const Point& a, const Point& b, const Point& p) {
  const double det = (b.x() - a.x()) * (p.y() - a.y()) - (p.x() - a.x()) * (b.y() - a.y());
  return det > 0 ? 1 : det < 0 ? -1 : 0;
}

int main() {
  // A grid of neighbouring doubles around (0.5, 0.5), seen from a line through it (Kettner et al.
  // 2008).
  const Point a{12, 12}, b{24, 24};
  constexpr double step = 0x1p-53;
  int differing = 0, on_line = 0;
  for (int i = 0; i < 256; ++i)
    for (int k = 0; k < 256; ++k) {
      const Point p{0.5 + i * step, 0.5 + k * step};
      const CGAL::Orientation exact = CGAL::orientation(a, b, p);
      on_line += exact == CGAL::COLLINEAR ? 1 : 0;
      differing += side_in_doubles(a, b, p) != static_cast<int>(exact) ? 1 : 0;
    }
  std::printf("exactly on the line: %d of 65536; doubles misplace %d\n", on_line, differing);
  return differing > 0 ? 0 : 1;
}
