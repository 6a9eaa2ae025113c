#include "kernel/solidify/crossings/chords.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/geometry/boxes.h"
#include "kernel/solidify/planes/number_table.h"
#include "kernel/solidify/shells/shell_mesh.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// Planes that differ by less do not cross in a line that means anything: half a degree, as
/// Tolerances::coplanar_deg.
constexpr double kParallelSine = 0.0087;

/// Up to so many corners both polygons of a pair are asked where they have their common line: more
/// would make a wall with many windows quadratic.
constexpr std::size_t kFewCorners = 32;

/// Looking up a point, or making one.
constexpr std::int64_t kStepsPerNewPoint = 32;

/// Where a polygon has the line that it shares with another one's plane.
struct Stretch {
  double from = 0, to = 0;  ///< along the line
  int from_point = -1, to_point = -1;
};

class ChordFinder {
 public:
  ChordFinder(const Soup& soup, std::span<const PolygonShape> shapes, double reach,
              GrowingPoints& points, Work& work)
      : soup_(soup), shapes_(shapes), reach_(reach), points_(points), work_(work) {
    const std::size_t count = soup.polygons.size();
    boxes_.resize(count);
    middles_.resize(count);
    own_.resize(count);
    chords_.resize(count);
    for (int p = 0; p < soup.polygon_count(); ++p) measure(p);
  }

  std::vector<std::vector<PointPair>> run() {
    add_edges_on_planes();
    add_crossings();
    for (auto& chords : chords_) {
      std::ranges::sort(chords);
      chords.erase(std::unique(chords.begin(), chords.end()), chords.end());
    }
    return std::move(chords_);
  }

 private:
  void measure(int p) {
    const auto corners = soup_.corners_of(p);
    for (const int v : corners) {
      boxes_[at(p)].grow(points_.place(v));
      middles_[at(p)] = middles_[at(p)] + points_.place(v);
    }
    middles_[at(p)] = 1.0 / static_cast<double>(corners.size()) * middles_[at(p)];
    own_[at(p)].assign(corners.begin(), corners.end());
    std::ranges::sort(own_[at(p)]);
  }

  /// How far a point is in front of a polygon's plane; its own corners lie on it, though published
  /// ones may be out of plane by millimetres.
  [[nodiscard]] double height(int point, int polygon) const {
    if (std::ranges::binary_search(own_[at(polygon)], point)) return 0;
    return dot(shapes_[at(polygon)].unit, points_.place(point) - middles_[at(polygon)]);
  }

  [[nodiscard]] bool is_same_body(int p, int q) const {
    return soup_.polygons[at(p)].body == soup_.polygons[at(q)].body;
  }

  /// Edges of others that lie on a polygon's plane, near the polygon, are chords of it.
  void add_edges_on_planes() {
    const ShellMesh mesh = linked_rings(soup_);
    std::vector<Box> boxes(soup_.corners.size());
    for (std::size_t h = 0; h < boxes.size(); ++h)
      for (const int v : {soup_.corners[h], soup_.corners[at(mesh.next[h])]})
        boxes[h].grow(points_.place(v));
    const BoxTree edges(std::move(boxes));
    for (int p = 0; p < soup_.polygon_count(); ++p)
      edges.search([&](const Box& box) { return overlap(box, boxes_[at(p)], reach_); },
                   [&](int h) {
                     const int q = mesh.polygon_of[at(h)];
                     work_.add(1);
                     if (work_.is_used_up() || q == p || !is_same_body(p, q)) return;
                     const int from = soup_.corners[at(h)],
                               to = soup_.corners[at(mesh.next[at(h)])];
                     if (std::abs(height(from, p)) <= reach_ && std::abs(height(to, p)) <= reach_)
                       add_chord(p, from, to);
                   });
  }

  void add_chord(int p, int from, int to) {
    if (from != to) chords_[at(p)].emplace_back(std::minmax(from, to));
  }

  /// Where two polygons cross they get a chord each.
  void add_crossings() {
    const BoxTree tree(boxes_);
    for (int p = 0; p < soup_.polygon_count(); ++p)
      tree.search([&](const Box& box) { return overlap(box, boxes_[at(p)], reach_); },
                  [&](int q) {
                    if (q <= p || !is_same_body(p, q)) return;
                    work_.add(std::ssize(own_[at(p)]) + std::ssize(own_[at(q)]));
                    if (!work_.is_used_up()) add_pair(p, q);
                  });
  }

  /// The line that two planes share, as far as it runs in both polygons. Of one with many corners
  /// its subdivision finds out where the line leaves it.
  void add_pair(int p, int q) {
    const Vec3 across = cross(shapes_[at(p)].unit, shapes_[at(q)].unit);
    if (length(across) < kParallelSine) return;
    const Vec3 line = normalised(across);
    const bool is_p_smaller = own_[at(p)].size() <= own_[at(q)].size();
    const int small = is_p_smaller ? p : q, large = is_p_smaller ? q : p;
    auto found = stretches(small, large, line);
    if (found.empty()) return;
    if (own_[at(large)].size() <= kFewCorners) found = common(found, stretches(large, small, line));
    for (const Stretch& stretch : found) {
      const PointPair chord = std::minmax(stretch.from_point, stretch.to_point);
      if (is_ring_edge(small, chord) || !reaches(large, chord)) continue;
      add_chord(small, chord.first, chord.second);
      add_chord(large, chord.first, chord.second);
    }
  }

  /// Where polygon p has the line in which its plane meets that of q.
  std::vector<Stretch> stretches(int p, int q, Vec3 line) {
    std::vector<std::pair<double, int>> ends;
    for (const int r : soup_.rings_of(p)) {
      const auto ring = soup_.ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const PointPair edge = std::minmax(ring[i], ring[(i + 1) % ring.size()]);
        const double low = height(edge.first, q), high = height(edge.second, q);
        if ((low >= 0) == (high >= 0)) continue;
        const int point = crossing(edge, low, high);
        ends.emplace_back(dot(line, points_.place(point)), point);
      }
    }
    std::ranges::sort(ends);
    std::vector<Stretch> found;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
      if (ends[i].second != ends[i + 1].second)
        found.push_back({ends[i].first, ends[i + 1].first, ends[i].second, ends[i + 1].second});
    return found;
  }

  /// What stretches of one line have in common with others.
  [[nodiscard]] static std::vector<Stretch> common(std::span<const Stretch> first,
                                                   std::span<const Stretch> second) {
    std::vector<Stretch> found;
    for (const Stretch& a : first)
      for (const Stretch& b : second) {
        const Stretch& begins = a.from < b.from ? b : a;
        const Stretch& ends = a.to > b.to ? b : a;
        if (begins.from < ends.to)
          found.push_back({begins.from, ends.to, begins.from_point, ends.to_point});
      }
    return found;
  }

  /// The point of an edge at which the height is zero: an end of it if that is within reach.
  int crossing(const PointPair& edge, double low, double high) {
    if (std::abs(low) <= reach_ && std::abs(low) <= std::abs(high)) return edge.first;
    if (std::abs(high) <= reach_) return edge.second;
    const Vec3 from = points_.place(edge.first), to = points_.place(edge.second);
    work_.add(kStepsPerNewPoint);
    return points_.point_at(from + (low / (low - high)) * (to - from));
  }

  [[nodiscard]] bool is_ring_edge(int p, const PointPair& edge) const {
    for (const int r : soup_.rings_of(p)) {
      const auto ring = soup_.ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (PointPair(std::minmax(ring[i], ring[(i + 1) % ring.size()])) == edge) return true;
    }
    return false;
  }

  [[nodiscard]] bool reaches(int p, const PointPair& edge) const {
    return comes_near(boxes_[at(p)], points_.place(edge.first), points_.place(edge.second), reach_);
  }

  const Soup& soup_;
  std::span<const PolygonShape> shapes_;
  double reach_;
  GrowingPoints& points_;
  Work& work_;
  std::vector<Box> boxes_;
  std::vector<Vec3> middles_;
  std::vector<std::vector<int>> own_;  ///< by polygon its corners, sorted
  std::vector<std::vector<PointPair>> chords_;
};

}  // namespace

GrowingPoints::GrowingPoints(std::vector<exact::GridPoint> points, double weld)
    : points_(std::move(points)), weld_(weld) {
  for (int v = 0; v < std::ssize(points_); ++v) enter(v);
}

int GrowingPoints::point_at(Vec3 where) {
  const GridCell middle = cell_of(where);
  int best = -1;
  double least = weld_;
  for (int i = 0; i < 27; ++i) {
    const auto found =
        cells_.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1});
    if (found == cells_.end()) continue;
    for (const int v : found->second) {
      const double away = length(place(v) - where);
      if (away > least || (away == least && best >= 0)) continue;
      best = v;
      least = away;
    }
  }
  if (best >= 0) return best;
  points_.push_back(exact::round_to_grid(where, 1));
  enter(static_cast<int>(points_.size()) - 1);
  return static_cast<int>(points_.size()) - 1;
}

std::size_t GrowingPoints::Hash::operator()(const GridCell& cell) const noexcept {
  return table_key(cell, 0);
}

GrowingPoints::GridCell GrowingPoints::cell_of(Vec3 where) const {
  const auto number = [&](double c) { return static_cast<std::int64_t>(std::floor(c / weld_)); };
  return {number(where.x), number(where.y), number(where.z)};
}

void GrowingPoints::enter(int point) { cells_[cell_of(place(point))].push_back(point); }

std::vector<std::vector<PointPair>> find_chords(const Soup& soup,
                                                std::span<const PolygonShape> shapes, double reach,
                                                GrowingPoints& points, Work& work) {
  ORIEL_ASSERT(shapes.size() == soup.polygons.size());
  return ChordFinder(soup, shapes, reach, points, work).run();
}

}  // namespace oriel::detail
