#include "kernel/solidify/mend/caps.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/solidify/shells/edge_groups.h"
#include "model/vec3.h"

#include <algorithm>
#include <bit>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace oriel::detail {

namespace {

/// Polygons at less than this angle to a cap, on the same side of an edge, lie in it.
constexpr double kSameWay_rad = 2 * std::numbers::pi / 180;

/// Cutting a loop into plane pieces takes the cube of its points.
constexpr std::size_t kLongestBentLoop = 64;

/// What a look at an edge takes while a loop is followed.
constexpr std::int64_t kStepsPerWalk = 8;

struct OpenHalfEdge {
  int from, to, polygon;
};

class CapFinder {
 public:
  CapFinder(const Soup& soup, std::span<const PolygonShape> shapes, double reach, double max_area,
            Work& work)
      : soup_(soup), shapes_(shapes), reach_(reach), max_area_(max_area), work_(work) {
    collect_edges();
  }

  std::vector<CapDraft> run() {
    for (const OpenHalfEdge& edge : open_) {
      const Vec3 normal = shapes_[at(edge.polygon)].unit;
      if (length(normal) > 0) follow(edge.to, edge.from, normal, edge.polygon);
    }
    for (const OpenHalfEdge& edge : open_) {
      follow_corner(edge.from, edge.to, edge.polygon);
      follow_corner(edge.to, edge.from, edge.polygon);
    }
    close_bent_loops();
    return std::move(caps_);
  }

 private:
  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }

  void collect_edges() {
    const ShellMesh mesh = linked_rings(soup_);
    neighbours_.resize(soup_.points.size());
    open_at_.resize(soup_.points.size());
    EdgeGroups(soup_, mesh).for_each([&](EdgeGroup group) {
      const int from = soup_.corners[at(group[0])];
      const int to = soup_.corners[at(mesh.next[at(group[0])])];
      auto& polygons = polygons_at_[std::minmax({from, to})];
      if (polygons.empty()) {
        neighbours_[at(from)].push_back(to);
        neighbours_[at(to)].push_back(from);
      }
      for (const int h : group) {
        const int p = mesh.polygon_of[at(h)];
        polygons.push_back({p, soup_.corners[at(h)] < soup_.corners[at(mesh.next[at(h)])]});
      }
      if (group.size() > 1) return;
      open_.push_back({from, to, mesh.polygon_of[at(group[0])]});
      open_at_[at(from)].push_back(to);
      open_at_[at(to)].push_back(from);
    });
  }

  /// The planes of the edge from → to with the open edges that go on from `to`.
  void follow_corner(int from, int to, int polygon) {
    const Vec3 along = normalised(place(to) - place(from));
    for (const int next : open_at_[at(to)]) {
      const Vec3 normal = cross(along, normalised(place(next) - place(to)));
      if (next != from && length(normal) > std::sin(kSameWay_rad))
        follow(from, to, normalised(normal), polygon);
    }
  }

  using WalkedHalfEdge = std::pair<int, int>;

  /// Follows the smallest loop with the edge from → to, its inside to the left seen against the
  /// normal, and keeps it as a cap if it is a hole.
  void follow(int from, int to, Vec3 normal, int polygon) {
    if (!is_first_visit(from, to, normal)) return;
    const double offset = dot(normal, place(from));
    const auto is_near = [&](int v) { return std::abs(dot(normal, place(v)) - offset) <= reach_; };
    if (!is_near(to)) return;
    std::vector<int> ring{from};
    WalkedHalfEdge marked{from, to};  // the last one whose number is a power of two
    for (int before = from, v = to; v != from;) {
      work_.add(kStepsPerWalk * std::ssize(neighbours_[at(v)]));
      if (work_.is_used_up()) return;
      const int next = leftmost(before, v, normal, is_near);
      if (next < 0) return;
      ring.push_back(v);
      is_first_visit(v, next, normal);
      before = std::exchange(v, next);
      // Where it comes to a half-edge again it goes round for ever and never comes to its start
      // (cycles as Brent finds them, 1980).
      if (marked == WalkedHalfEdge{before, v}) return;
      if (std::has_single_bit(ring.size())) marked = {before, v};
    }
    keep_if_hole(std::move(ring), normal, polygon);
  }

  /// The next point of the loop that comes from `before` to `v`: the first clockwise from where it
  /// came from; -1 if there is none.
  template <class IsNear>
  [[nodiscard]] int leftmost(int before, int v, Vec3 normal, IsNear is_near) const {
    const Vec3 back = normalised(place(before) - place(v));
    int best = -1;
    double least = 0;
    for (const int w : neighbours_[at(v)]) {
      if (w == before || !is_near(w)) continue;
      const Vec3 way = normalised(place(w) - place(v));
      double angle = std::atan2(-dot(cross(back, way), normal), dot(back, way));
      if (angle <= 0) angle += 2 * std::numbers::pi;
      if (best >= 0 && angle >= least) continue;
      best = w;
      least = angle;
    }
    return best;
  }

  void keep_if_hole(std::vector<int> ring, Vec3 normal, int polygon) {
    std::vector<int> points = ring;
    std::ranges::sort(points);
    if (ring.size() < 3 || std::ranges::adjacent_find(points) != points.end()) return;
    const double area = dot(area_of(ring), normal);
    if (area <= 0 || area > max_area_) return;
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (is_covered_at(ring[i], ring[(i + 1) % ring.size()], normal)) return;
    if (!known_.insert(std::move(points)).second) return;
    caps_.push_back({std::move(ring), area, polygon});
  }

  using HoleLoop = std::vector<int>;

  /// Loops of open edges that no cap has.
  void close_bent_loops() {
    std::map<int, std::vector<int>> open_at;  // by point
    std::set<std::pair<int, int>> capped;
    for (const CapDraft& cap : caps_)
      for (std::size_t i = 0; i < cap.ring.size(); ++i)
        capped.insert(std::minmax({cap.ring[i], cap.ring[(i + 1) % cap.ring.size()]}));
    std::map<int, int> polygon_at;
    for (const OpenHalfEdge& edge : open_) {
      if (capped.contains(std::minmax({edge.from, edge.to}))) continue;
      open_at[edge.from].push_back(edge.to);
      open_at[edge.to].push_back(edge.from);
      polygon_at[edge.from] = edge.polygon;
    }
    std::set<int> seen;
    for (const auto& [start, ends] : open_at) {
      HoleLoop loop;
      int before = -1, v = start;
      while (seen.insert(v).second && open_at.at(v).size() == 2) {
        loop.push_back(v);
        const auto& next = open_at.at(v);
        v = std::exchange(before, v) == next[0] ? next[1] : next[0];
      }
      if (v == start && loop.size() >= 4 && loop.size() <= kLongestBentLoop)
        keep_pieces(loop, polygon_at[start]);
    }
  }

  void keep_pieces(HoleLoop loop, int polygon) {
    std::vector<CapDraft> pieces;
    double area = 0;
    while (!loop.empty()) {
      if (work_.is_used_up()) return;
      HoleLoop piece = take_plane_piece(loop);
      const Vec3 vector = area_of(piece);
      const Vec3 normal = normalised(vector);
      area += length(vector);
      if (area > max_area_ || length(vector) == 0) return;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const int from = piece[i], to = piece[(i + 1) % piece.size()];
        if (polygons_at_.contains(std::minmax({from, to})) && is_covered_at(from, to, normal))
          return;
      }
      pieces.push_back({std::move(piece), length(vector), polygon});
    }
    caps_.insert(caps_.end(), pieces.begin(), pieces.end());
  }

  /// Takes the largest plane piece off a loop: of those with the most points the one with the
  /// shortest chord. What is left of the loop stays; nothing if all of it is plane.
  HoleLoop take_plane_piece(HoleLoop& loop) const {
    const std::size_t size = loop.size();
    work_.add(std::ssize(loop) * std::ssize(loop));
    if (is_plane(loop)) return std::exchange(loop, {});
    HoleLoop best;
    std::size_t best_start = 0;
    for (std::size_t count = size - 1; count >= 3 && best.empty(); --count)
      for (std::size_t start = 0; start < size; ++start) {
        HoleLoop piece;
        for (std::size_t i = 0; i < count; ++i) piece.push_back(loop[(start + i) % size]);
        if (!is_plane(piece) || (!best.empty() && chord(best) <= chord(piece))) continue;
        best = std::move(piece);
        best_start = start;
      }
    HoleLoop rest;
    for (std::size_t i = best.size() - 1; i <= size; ++i)
      rest.push_back(loop[(best_start + i) % size]);
    loop = std::move(rest);
    return best;
  }

  [[nodiscard]] double chord(const HoleLoop& piece) const {
    return length(place(piece.back()) - place(piece.front()));
  }

  [[nodiscard]] Vec3 area_of(const HoleLoop& ring) const {
    return area_vector(ring.size(), [&](std::size_t i) { return place(ring[i]); });
  }

  [[nodiscard]] bool is_plane(const HoleLoop& ring) const {
    const Vec3 normal = normalised(area_of(ring));
    return std::ranges::all_of(
        ring, [&](int v) { return std::abs(dot(normal, place(v) - place(ring[0]))) <= reach_; });
  }

  /// A polygon at that edge lies in the plane, on the side of the cap.
  [[nodiscard]] bool is_covered_at(int from, int to, Vec3 normal) const {
    const Vec3 along = normalised(place(to) - place(from));
    const Vec3 inward = cross(normal, along);
    for (const auto& [polygon, runs_up] : polygons_at_.at(std::minmax({from, to}))) {
      const Vec3 own = runs_up == (from < to) ? along : -along;
      const Vec3 way = cross(shapes_[at(polygon)].unit, own);
      if (dot(normalised(way - dot(way, along) * along), inward) > std::cos(kSameWay_rad))
        return true;
    }
    return false;
  }

  /// So that a rim of many edges is followed once, not from each of them.
  bool is_first_visit(int from, int to, Vec3 normal) {
    const auto rounded = [](double c) { return static_cast<int>(std::lround(64 * c)); };
    return visited_.insert({from, to, rounded(normal.x), rounded(normal.y), rounded(normal.z)})
        .second;
  }

  struct PolygonAtEdge {
    int polygon;
    bool runs_up;  ///< from the smaller point to the larger one
  };

  const Soup& soup_;
  std::span<const PolygonShape> shapes_;
  double reach_, max_area_;
  Work& work_;
  std::vector<OpenHalfEdge> open_;
  std::vector<std::vector<int>> neighbours_, open_at_;  ///< by point
  std::map<std::pair<int, int>, std::vector<PolygonAtEdge>> polygons_at_;
  std::set<std::array<int, 5>> visited_;
  std::set<std::vector<int>> known_;  ///< the points of caps, sorted
  std::vector<CapDraft> caps_;
};

}  // namespace

std::vector<CapDraft> find_caps(const Soup& soup, std::span<const PolygonShape> shapes,
                                double reach, double max_area, Work& work) {
  ORIEL_ASSERT(shapes.size() == soup.polygons.size());
  return CapFinder(soup, shapes, reach, max_area, work).run();
}

}  // namespace oriel::detail
