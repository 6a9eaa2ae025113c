#include "kernel/blocks/simplify_outlines.h"

#include "kernel/geometry/boxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace oriel {

namespace {

/// Lines that meet at a smaller angle do not meet in a place that one could rely on.
constexpr double kLeastSine = 0.17;  // 10°
/// Sides that run against each other deviate by less from opposite directions.
constexpr double kAgainst = -0.985;  // 10°

Vec3 direction(Vec3 from, Vec3 to) { return (1 / length(to - from)) * (to - from); }

double sine(Vec3 u, Vec3 v) { return u.x * v.y - u.y * v.x; }

struct PlanLine {
  Vec3 point, along;
};

/// A corner that takes the place of some others.
struct NewCorner {
  Vec3 point;
  /// The directions of the edges to it and from it.
  Vec3 comes_along, goes_along;
  /// It stands instead of `count` corners, the first of them so many behind the start of the short
  /// edge.
  int first = 0, count = 0;
};

/// Where two lines meet.
std::optional<NewCorner> meeting_of(PlanLine p, PlanLine q, int first, int count) {
  const double s = sine(p.along, q.along);
  if (std::abs(s) < kLeastSine) return std::nullopt;
  return NewCorner{p.point + (sine(q.point - p.point, q.along) / s) * p.along, p.along, q.along,
                   first, count};
}

/// From p to q and back almost the same way.
bool turns_around(Vec3 p, Vec3 q, Vec3 next) {
  return dot(direction(p, q), direction(q, next)) < kAgainst;
}

bool are_apart(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double reach_m) {
  return !do_cross(a, b, c, d, {0, 0, 1}) &&
         std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d),
                   distance_to_segment(c, a, b), distance_to_segment(d, a, b)}) >= reach_m;
}

/// One way to take a short edge off an outline.
struct OutlineChange {
  Outline outline;
  double gained_m2 = 0;  ///< negative: lost
  Box changed;           ///< of all corners that come or go
  /// The edge that is shifted, where the shorter of two parts of a facade follows the longer one.
  std::optional<std::pair<Vec3, Vec3>> shifted{};
};

class OutlineSimplifier {
 public:
  OutlineSimplifier(std::vector<Outline>& outlines, const OutlineLimits& limits)
      : outlines_(outlines), limits_(limits), before_(outlines) {
    for (const Outline& outline : outlines)
      for (const Vec3 p : outline) around_.grow(p);
  }

  int run() {
    for (Outline& outline : outlines_) outline = without_straight_corners(std::move(outline));
    while (take_one_off()) continue;
    return static_cast<int>(short_edges().size());
  }

 private:
  struct Edge {
    double length_m;
    std::size_t outline, index;
  };

  /// The shortest first; of equal ones by their place, wherever an outline begins.
  [[nodiscard]] std::vector<Edge> short_edges() const {
    std::vector<Edge> edges;
    for (std::size_t o = 0; o < outlines_.size(); ++o)
      for (std::size_t i = 0; i < outlines_[o].size(); ++i)
        if (const double m = length(corner(o, i, 1) - corner(o, i, 0));
            m < limits_.least_edge_m - limits_.reach_m)
          edges.push_back({m, o, i});
    std::ranges::sort(edges, {}, [&](const Edge& e) {
      const Vec3 p = corner(e.outline, e.index, 0);
      return std::tuple(e.length_m, p.x, p.y);
    });
    return edges;
  }

  /// The corner so many behind the start of edge i.
  [[nodiscard]] Vec3 corner(std::size_t outline, std::size_t i, int behind) const {
    const Outline& all = outlines_[outline];
    const auto n = std::ssize(all);
    return all[static_cast<std::size_t>((static_cast<std::ptrdiff_t>(i) + behind + n) % n)];
  }

  /// False if no short edge can go. What could not go is asked again only once all others were.
  bool take_one_off() {
    for (const Edge& edge : short_edges()) {
      const Vec3 from = corner(edge.outline, edge.index, 0),
                 to = corner(edge.outline, edge.index, 1);
      const std::array key{from.x, from.y, to.x, to.y};
      if (stuck_.contains(key)) continue;
      if (take_off(edge)) {
        has_changed_ = true;
        return true;
      }
      stuck_.insert(key);
    }
    stuck_.clear();
    return std::exchange(has_changed_, false);
  }

  bool take_off(const Edge& edge) {
    if (outlines_[edge.outline].size() <= 4) return false;
    std::vector<OutlineChange> changes = changes_for(edge);
    std::ranges::stable_sort(changes, {},
                             [](const OutlineChange& c) { return std::abs(c.gained_m2); });
    for (OutlineChange& change : changes) {
      if (!may_be(change, edge.outline)) continue;
      outlines_[edge.outline] = std::move(change.outline);
      return true;
    }
    return false;
  }

  [[nodiscard]] std::vector<OutlineChange> changes_for(const Edge& edge) const {
    const std::size_t o = edge.outline, i = edge.index;
    const auto at = [&](int behind) { return corner(o, i, behind); };
    const auto along = [&](int behind) { return direction(at(behind), at(behind + 1)); };
    const Vec3 second_before = along(-2), before = along(-1), after = along(1),
               second_after = along(2);
    std::vector<OutlineChange> changes;
    const auto add = [&](std::optional<NewCorner> put, std::optional<Vec3> end = {}) {
      auto change = put ? changed(o, i, *put) : std::nullopt;
      if (!change) return;
      if (end) change->shifted.emplace(put->point, *end);
      changes.push_back(std::move(*change));
    };
    // The shorter of the edges before and behind goes through the other end of the short one.
    const double before_m = length(at(0) - at(-1)), after_m = length(at(2) - at(1));
    if (before_m <= after_m)
      add(meeting_of({at(-2), second_before}, {at(1), before}, -1, 2), at(1));
    if (after_m <= before_m) add(meeting_of({at(0), after}, {at(3), second_after}, 1, 2), at(0));
    if (dot(before, after) < kAgainst) {
      add(meeting_of({at(-2), second_before}, {at(1), after}, -1, 3));
      add(meeting_of({at(0), before}, {at(3), second_after}, 0, 3));
    } else if (turn(o, i, 0) == turn(o, i, 1)) {
      add(meeting_of({at(0), before}, {at(1), after}, 0, 2));
    }
    if (distance_to_segment(at(0), at(-1), at(1)) <= limits_.reach_m)
      add(NewCorner{at(-1), second_before, before, -1, 2});
    if (distance_to_segment(at(1), at(0), at(2)) <= limits_.reach_m)
      add(NewCorner{at(2), after, second_after, 1, 2});
    return changes;
  }

  [[nodiscard]] bool turn(std::size_t o, std::size_t i, int behind) const {
    const Vec3 p = corner(o, i, behind);
    return sine(p - corner(o, i, behind - 1), corner(o, i, behind + 1) - p) > 0;
  }

  /// The outline with a new corner. Nothing if edges turn back that stay, or nothing is left.
  [[nodiscard]] std::optional<OutlineChange> changed(std::size_t o, std::size_t i,
                                                     const NewCorner& put) const {
    const int n = static_cast<int>(outlines_[o].size());
    const Vec3 from = corner(o, i, put.first - 1), to = corner(o, i, put.first + put.count);
    if (dot(put.point - from, put.comes_along) < 0 || dot(to - put.point, put.goes_along) < 0)
      return std::nullopt;
    for (int k = put.first - 1; limits_.is_fixed && k < put.first + put.count; ++k)
      if (limits_.is_fixed(corner(o, i, k), corner(o, i, k + 1))) return std::nullopt;
    OutlineChange change;
    change.changed.grow(put.point);
    for (int k = -1; k <= put.count; ++k) change.changed.grow(corner(o, i, put.first + k));
    change.outline.push_back(put.point);
    for (int k = put.count; k < n; ++k) change.outline.push_back(corner(o, i, put.first + k));
    change.outline = without_straight_corners(std::move(change.outline));
    if (change.outline.size() < 4) return std::nullopt;
    change.gained_m2 =
        signed_area(change.outline, {0, 0, 1}) - signed_area(outlines_[o], {0, 0, 1});
    return change;
  }

  [[nodiscard]] bool may_be(const OutlineChange& change, std::size_t o) const {
    const double most_m2 = limits_.least_edge_m * limits_.least_edge_m;
    if (change.shifted ? !stays_near(*change.shifted) : std::abs(change.gained_m2) >= most_m2)
      return false;
    if (change.gained_m2 > 0 && !may_cover(change.changed)) return false;
    return is_free(change, o);
  }

  /// All of the edge is nearer to an outline as it came than the least edge is long.
  [[nodiscard]] bool stays_near(const std::pair<Vec3, Vec3>& edge) const {
    const auto& [p, q] = edge;
    return std::ranges::all_of(std::array{p, 0.5 * (p + q), q}, [&](Vec3 point) {
      return std::ranges::any_of(before_, [&](const Outline& outline) {
        for (std::size_t i = 0; i < outline.size(); ++i)
          if (distance_to_segment(point, outline[i], outline[(i + 1) % outline.size()]) <
              limits_.least_edge_m)
            return true;
        return false;
      });
    });
  }

  [[nodiscard]] bool may_cover(const Box& gained) const {
    return limits_.may_cover && gained.min.x >= around_.min.x && gained.min.y >= around_.min.y &&
           gained.max.x <= around_.max.x && gained.max.y <= around_.max.y &&
           limits_.may_cover(gained);
  }

  /// Edges near what has changed touch nothing.
  [[nodiscard]] bool is_free(const OutlineChange& change, std::size_t o) const {
    const Outline& own = change.outline;
    const std::size_t n = own.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 a = own[i], b = own[(i + 1) % n];
      Box box;
      box.grow(a);
      box.grow(b);
      if (!overlap(box, change.changed)) continue;
      if (turns_around(a, b, own[(i + 2) % n])) return false;
      for (std::size_t k = i + 2; k < i + n - 1; ++k)
        if (!are_apart(a, b, own[k % n], own[(k + 1) % n], limits_.reach_m)) return false;
      if (touches_others(a, b, o)) return false;
    }
    return true;
  }

  [[nodiscard]] bool touches_others(Vec3 a, Vec3 b, std::size_t o) const {
    for (std::size_t q = 0; q < outlines_.size(); ++q)
      for (std::size_t k = 0; q != o && k < outlines_[q].size(); ++k)
        if (!are_apart(a, b, corner(q, k, 0), corner(q, k, 1), limits_.reach_m)) return true;
    return false;
  }

  /// Without corners on the straight line between those beside them, and of corners that are one
  /// without all but the first.
  [[nodiscard]] Outline without_straight_corners(Outline outline) const {
    for (std::size_t i = 0; outline.size() > 3 && i < outline.size();) {
      const std::size_t n = outline.size();
      const Vec3 p = outline[i], before = outline[(i + n - 1) % n], behind = outline[(i + 1) % n];
      const bool is_twin = length(behind - p) <= limits_.reach_m / 2;
      const bool is_straight = !is_twin && dot(p - before, behind - p) > 0 &&
                               distance_to_segment(p, before, behind) <= kThin_m;
      if (!is_twin && !is_straight) {
        ++i;
        continue;
      }
      outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(is_twin ? (i + 1) % n : i));
      i = 0;
    }
    return outline;
  }

  std::vector<Outline>& outlines_;
  const OutlineLimits& limits_;
  std::set<std::array<double, 4>> stuck_;  ///< edges that could not go, by their ends
  const std::vector<Outline> before_;      ///< as they came
  Box around_;                             ///< all of them
  bool has_changed_ = false;               ///< since all were asked
};

}  // namespace

int simplify_outlines(std::vector<Outline>& outlines, const OutlineLimits& limits) {
  return OutlineSimplifier(outlines, limits).run();
}

}  // namespace oriel
