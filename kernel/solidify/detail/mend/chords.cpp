#include "kernel/solidify/detail/mend/chords.h"

#include "kernel/solidify/detail/mend/box_tree.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Planes that differ by less do not cross in a line that means anything: half a degree, as
/// Tolerances::coplanar_deg.
constexpr double kParallelSine = 0.0087;

/// Where the line that two planes share is in a polygon: from point to point of the soup.
struct Stretch {
  double from = 0, to = 0;  ///< along the line
  int from_point = -1, to_point = -1;
};

class ChordFinder {
 public:
  ChordFinder(const Soup& soup, const std::vector<PolygonShape>& shapes, double reach,
              GrowingPoints& points)
      : soup_(soup),
        shapes_(shapes),
        reach_(reach),
        points_(points),
        chords_(soup.polygons.size()) {
    boxes_.resize(soup.polygons.size());
    middles_.resize(soup.polygons.size());
    own_.resize(soup.polygons.size());
    for (int p = 0; p < soup.polygon_count(); ++p) {
      const auto corners = soup.corners_of(p);
      for (const int v : corners) {
        boxes_[at(p)].grow(points_.place(v));
        middles_[at(p)] = middles_[at(p)] + points_.place(v);
      }
      own_[at(p)].assign(corners.begin(), corners.end());
      std::ranges::sort(own_[at(p)]);
      middles_[at(p)] = 1.0 / static_cast<double>(corners.size()) * middles_[at(p)];
    }
  }

  std::vector<std::vector<Edge>> run() {
    const BoxTree tree(boxes_);
    for (int p = 0; p < soup_.polygon_count(); ++p)
      tree.search([&](const Box& box) { return is_near(box, boxes_[at(p)]); },
                  [&](int q) {
                    if (q > p && soup_.polygons[at(q)].body == soup_.polygons[at(p)].body)
                      add_pair(p, q);
                  });
    for (auto& chords : chords_) {
      std::ranges::sort(chords);
      chords.erase(std::unique(chords.begin(), chords.end()), chords.end());
    }
    return std::move(chords_);
  }

 private:
  [[nodiscard]] bool is_near(const Box& a, const Box& b) const {
    return a.min.x <= b.max.x + reach_ && b.min.x <= a.max.x + reach_ &&
           a.min.y <= b.max.y + reach_ && b.min.y <= a.max.y + reach_ &&
           a.min.z <= b.max.z + reach_ && b.min.z <= a.max.z + reach_;
  }

  /// How far a point is in front of a polygon's plane; its own corners lie on it, though published
  /// ones may be out of plane by millimetres.
  [[nodiscard]] double height(int point, int polygon) const {
    if (std::ranges::binary_search(own_[at(polygon)], point)) return 0;
    return dot(shapes_[at(polygon)].unit, points_.place(point) - middles_[at(polygon)]);
  }

  void add_pair(int p, int q) {
    add_edges_on(p, q);
    add_edges_on(q, p);
    const Vec3 line = cross(shapes_[at(p)].unit, shapes_[at(q)].unit);
    if (length(line) < kParallelSine) return;
    const auto in_p = stretches(p, q, normalised(line)), in_q = stretches(q, p, normalised(line));
    for (const Stretch& a : in_p)
      for (const Stretch& b : in_q) add_common(p, q, a, b);
  }

  /// The edges of q that lie on p's plane become chords of p.
  void add_edges_on(int p, int q) {
    for (const int r : soup_.rings_of(q)) {
      const auto ring = soup_.ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const int from = ring[i], to = ring[(i + 1) % ring.size()];
        if (std::abs(height(from, p)) > reach_ || std::abs(height(to, p)) > reach_) continue;
        if (comes_near(boxes_[at(p)], points_.place(from), points_.place(to), reach_))
          add_chord(p, from, to);
      }
    }
  }

  void add_chord(int p, int from, int to) {
    if (from != to) chords_[at(p)].emplace_back(std::minmax(from, to));
  }

  /// Where polygon p has the line in which its plane meets that of q, in order along the line.
  std::vector<Stretch> stretches(int p, int q, Vec3 line) {
    std::vector<std::pair<double, int>> ends;
    for (const int r : soup_.rings_of(p)) {
      const auto ring = soup_.ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Edge edge = std::minmax(ring[i], ring[(i + 1) % ring.size()]);
        const double low = height(edge.first, q), high = height(edge.second, q);
        if ((low >= 0) == (high >= 0)) continue;
        const int point = crossing(edge, low, high);
        ends.emplace_back(dot(line, points_.place(point)), point);
      }
    }
    std::ranges::sort(ends);
    std::vector<Stretch> found;
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2)
      found.push_back({ends[i].first, ends[i + 1].first, ends[i].second, ends[i + 1].second});
    return found;
  }

  /// The point of an edge at which the height is zero: an end of it if that is within reach.
  int crossing(const Edge& edge, double low, double high) {
    if (std::abs(low) <= reach_ && std::abs(low) <= std::abs(high)) return edge.first;
    if (std::abs(high) <= reach_) return edge.second;
    const Vec3 from = points_.place(edge.first), to = points_.place(edge.second);
    return points_.point_at(from + (low / (low - high)) * (to - from));
  }

  /// What two stretches have in common becomes a chord of both polygons.
  void add_common(int p, int q, const Stretch& a, const Stretch& b) {
    const bool is_a_first = a.from<b.from, is_a_last = a.to> b.to;
    const double from = is_a_first ? b.from : a.from, to = is_a_last ? b.to : a.to;
    if (to <= from) return;
    const int first = is_a_first ? b.from_point : a.from_point;
    const int last = is_a_last ? b.to_point : a.to_point;
    add_chord(p, first, last);
    add_chord(q, first, last);
  }

  const Soup& soup_;
  const std::vector<PolygonShape>& shapes_;
  double reach_;
  GrowingPoints& points_;
  std::vector<Box> boxes_;
  std::vector<Vec3> middles_;
  std::vector<std::vector<int>> own_;  ///< by polygon its corners, sorted
  std::vector<std::vector<Edge>> chords_;
};

}  // namespace

GrowingPoints::GrowingPoints(std::vector<exact::GridPoint> points, double weld)
    : points_(std::move(points)), weld_(weld) {
  for (int v = 0; v < std::ssize(points_); ++v) enter(v);
}

int GrowingPoints::point_at(Vec3 where) {
  const Cell middle = cell_of(where);
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

GrowingPoints::Cell GrowingPoints::cell_of(Vec3 where) const {
  const auto number = [&](double c) { return static_cast<std::int64_t>(std::floor(c / weld_)); };
  return {number(where.x), number(where.y), number(where.z)};
}

void GrowingPoints::enter(int point) { cells_[cell_of(place(point))].push_back(point); }

std::vector<std::vector<Edge>> find_chords(const Soup& soup,
                                           const std::vector<PolygonShape>& shapes, double reach,
                                           GrowingPoints& points) {
  return ChordFinder(soup, shapes, reach, points).run();
}

}  // namespace oriel::detail
