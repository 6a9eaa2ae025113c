#include "kernel/solidify/missing/fits.h"

#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace oriel::detail {

namespace {

/// A polygon as a plane figure, grid units.
struct Figure {
  std::vector<Outline> outlines;
  std::vector<std::span<const int>> rings;  ///< the points of the outlines
  std::vector<int> points;                  ///< all of them, sorted
  Vec3 normal;
  double level = 0;  ///< of its points along the normal, on average
  Box box;
  bool is_supposed = false;
};

class FitCheck {
 public:
  FitCheck(const Soup& soup, std::span<const PolygonShape> shapes, double reach, Work& work)
      : reach_(reach), work_(work) {
    for (int p = 0; p < soup.polygon_count(); ++p) {
      Figure& figure = figures_.emplace_back();
      figure.normal = shapes[at(p)].unit;
      figure.is_supposed = soup.polygons[at(p)].source == kNoSource;
      figure.outlines = outlines_of(soup, p);
      for (const int r : soup.rings_of(p)) figure.rings.push_back(soup.ring(r));
      const auto corners = soup.corners_of(p);
      figure.points.assign(corners.begin(), corners.end());
      std::ranges::sort(figure.points);
      for (const Outline& outline : figure.outlines)
        for (const Vec3 point : outline) {
          figure.box.grow(point);
          figure.level += dot(figure.normal, point) / static_cast<double>(corners.size());
        }
    }
  }

  [[nodiscard]] bool run() const {
    std::vector<Box> boxes;
    for (const Figure& figure : figures_) boxes.push_back(figure.box);
    const BoxTree tree(std::move(boxes));
    bool fits = true;
    for (const Figure& figure : figures_) {
      if (!figure.is_supposed) continue;
      tree.for_each_overlap(figure.box, [&](int i) {
        const Figure& other = figures_[at(i)];
        work_.add(std::ssize(figure.points) + std::ssize(other.points));
        fits = fits && !work_.is_used_up() && (&other == &figure || !meet(figure, other));
      });
    }
    return fits;
  }

 private:
  [[nodiscard]] bool meet(const Figure& p, const Figure& q) const {
    return runs_through(p, q) || runs_through(q, p) || lies_on(p, q) || lies_on(q, p);
  }

  [[nodiscard]] double height(const Figure& figure, Vec3 point) const {
    return dot(figure.normal, point) - figure.level;
  }

  /// An edge of the one passes the inside of the other. One that begins or ends at a corner of the
  /// other is through its plane there.
  [[nodiscard]] bool runs_through(const Figure& one, const Figure& other) const {
    for (std::size_t r = 0; r < one.rings.size(); ++r)
      for (std::size_t i = 0; i < one.rings[r].size(); ++i) {
        const std::size_t j = (i + 1) % one.rings[r].size();
        if (has_corner(other, one.rings[r][i]) || has_corner(other, one.rings[r][j])) continue;
        const Vec3 from = one.outlines[r][i], to = one.outlines[r][j];
        const double before = height(other, from), after = height(other, to);
        if (std::min(before, after) >= -reach_ || std::max(before, after) <= reach_) continue;
        const Vec3 point = from + before / (before - after) * (to - from);
        if (contains_clearly(other.outlines, other.normal, point, reach_)) return true;
      }
    return false;
  }

  static bool has_corner(const Figure& figure, int point) {
    return std::ranges::binary_search(figure.points, point);
  }

  [[nodiscard]] bool lies_on(const Figure& one, const Figure& other) const {
    const auto inside = interior_point(one.outlines, one.normal);
    return inside && std::abs(height(other, *inside)) <= reach_ &&
           is_parallel(one.normal, other.normal) &&
           contains_clearly(other.outlines, other.normal, *inside, reach_);
  }

  /// To 5°: less is what faces that go on after each other differ by.
  static bool is_parallel(Vec3 p, Vec3 q) { return std::abs(dot(p, q)) > 0.996; }

  double reach_;
  Work& work_;
  std::vector<Figure> figures_;
};

}  // namespace

bool fits(const Soup& soup, std::span<const PolygonShape> shapes, double reach, Work& work) {
  return FitCheck(soup, shapes, reach, work).run();
}

}  // namespace oriel::detail
