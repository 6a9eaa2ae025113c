#include "kernel/solidify/detail/plane_clusters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace oriel::detail {

namespace {

using exact::Int128;
using Normal = std::array<std::int64_t, 3>;

Vec3 unit(const Normal& n) {
  return normalised(
      {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])});
}

/// What clustering needs to know of a polygon.
struct Shape {
  std::optional<Normal> normal;  ///< of its own, missing for a polygon without area
  double area = 0;               ///< grid units squared
  double uncertainty_rad = 0;    ///< how far its own normal may be off
};

Shape shape_of(const Soup& soup, const SoupPolygon& polygon, double offset_tolerance) {
  exact::Vector128 sum{};
  const auto at = [&](int v) -> const exact::GridPoint& {
    return soup.points[static_cast<std::size_t>(v)];
  };
  const exact::GridPoint& base = at(polygon.rings[0][0]);
  double reach2 = 0;
  for (const auto& ring : polygon.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto& p = at(ring[i]);
      const auto& q = at(ring[(i + 1) % ring.size()]);
      const Int128 px = p[0] - base[0], py = p[1] - base[1], pz = p[2] - base[2];
      const Int128 qx = q[0] - base[0], qy = q[1] - base[1], qz = q[2] - base[2];
      sum[0] += py * qz - pz * qy;
      sum[1] += pz * qx - px * qz;
      sum[2] += px * qy - py * qx;
      const double dx = static_cast<double>(px), dy = static_cast<double>(py),
                   dz = static_cast<double>(pz);
      reach2 = std::max(reach2, dx * dx + dy * dy + dz * dz);
    }
  }
  Shape shape;
  shape.normal = exact::direction(sum);
  shape.area = length({static_cast<double>(sum[0]), static_cast<double>(sum[1]),
                       static_cast<double>(sum[2])}) /
               2;
  const double height = reach2 > 0 ? shape.area / std::sqrt(reach2) : 0;
  shape.uncertainty_rad =
      height > 2 * offset_tolerance ? std::asin(2 * offset_tolerance / height) : std::numbers::pi;
  return shape;
}

/// Planes of one direction; `offsets` is keyed by normal · point.
struct NormalClass {
  Normal normal{};
  Vec3 unit;
  double size = 0;
  std::map<std::int64_t, int> offsets;
};

struct Span {
  std::int64_t low = 0, high = 0, mean = 0;
};

Span span_along(const Soup& soup, const SoupPolygon& polygon, const Normal& normal) {
  bool first = true;
  Int128 low = 0, high = 0, sum = 0;
  std::int64_t count = 0;
  for (const auto& ring : polygon.rings)
    for (const int v : ring) {
      const Int128 d = exact::dot(normal, soup.points[static_cast<std::size_t>(v)]);
      low = first ? d : std::min(low, d);
      high = first ? d : std::max(high, d);
      sum += d;
      ++count;
      first = false;
    }
  return {static_cast<std::int64_t>(low), static_cast<std::int64_t>(high),
          static_cast<std::int64_t>(sum / count)};
}

/// A place for a polygon: a class, and a plane of it or a new offset.
struct Fit {
  int normal_class = -1;
  bool is_known = false;
  std::int64_t offset = 0;
  double residual = 0;
};

class Clusterer {
 public:
  Clusterer(const Soup& soup, const Tolerances& tolerances)
      : soup_(soup),
        offset_tolerance_(tolerances.plane_offset_m / soup.grid_m),
        angle_tolerance_(tolerances.coplanar_deg * std::numbers::pi / 180) {
    for (const SoupPolygon& polygon : soup.polygons)
      shapes_.push_back(shape_of(soup, polygon, offset_tolerance_));
  }

  PlaneClusters run() {
    std::vector<int> by_area(soup_.polygons.size());
    std::iota(by_area.begin(), by_area.end(), 0);
    std::ranges::stable_sort(by_area, std::greater{}, [&](int i) { return shapes_[at(i)].area; });
    places_.resize(soup_.polygons.size());
    for (const int i : by_area) places_[at(i)] = place(i);
    for (int round = 0; round < 3 && separate_parallels(by_area); ++round) {
    }
    return result();
  }

 private:
  struct Place {
    int normal_class = -1;
    std::int64_t offset = 0;
    friend bool operator==(const Place&, const Place&) = default;
  };
  using Cell = std::tuple<int, int, int>;
  struct CellHash {
    std::size_t operator()(const Cell& c) const noexcept {
      const auto [x, y, z] = c;
      const auto u = [](int i) { return static_cast<std::uint32_t>(i); };  // may wrap round
      return (u(x) * 73856093U) ^ (u(y) * 19349663U) ^ (u(z) * 83492791U);
    }
  };

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  [[nodiscard]] double cell_size() const {
    return std::max(2 * std::sin(angle_tolerance_ / 2), 1e-9 /* tolerance 0 */);
  }

  [[nodiscard]] Cell cell_of(Vec3 u) const {
    const double size = cell_size();
    return {static_cast<int>(std::floor(u.x / size)), static_cast<int>(std::floor(u.y / size)),
            static_cast<int>(std::floor(u.z / size))};
  }

  /// Classes whose normal may be within the tolerance of ±`u`.
  [[nodiscard]] std::vector<int> near_classes(Vec3 u) const {
    std::vector<int> found;
    for (const Vec3 v : {u, -u}) {
      const auto [x, y, z] = cell_of(v);
      for (int n = 0; n < 27; ++n) {
        const auto cell = cells_.find({x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1});
        if (cell != cells_.end())
          found.insert(found.end(), cell->second.begin(), cell->second.end());
      }
    }
    std::ranges::sort(found);
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  [[nodiscard]] bool is_tilted_too_far(const Shape& shape, const NormalClass& c) const {
    const double allowed = angle_tolerance_ + shape.uncertainty_rad;
    if (!shape.normal || allowed >= std::numbers::pi / 2) return false;
    const Vec3 u = unit(*shape.normal);
    return std::asin(std::min(1.0, length(cross(u, c.unit)))) > allowed;
  }

  /// The best place for the polygon in one class, if there is one.
  [[nodiscard]] std::optional<Fit> fit(int polygon, int k) const {
    const NormalClass& c = classes_[at(k)];
    if (is_tilted_too_far(shapes_[at(polygon)], c)) return std::nullopt;
    const Span span = span_along(soup_, soup_.polygons[at(polygon)], c.normal);
    const double reach = offset_tolerance_ * c.size;
    const auto residual_of = [&](std::int64_t offset) {
      return std::max(std::abs(static_cast<double>(span.high - offset)),
                      std::abs(static_cast<double>(offset - span.low)));
    };
    std::optional<Fit> best;
    const auto from = static_cast<std::int64_t>(std::ceil(static_cast<double>(span.high) - reach));
    for (auto o = c.offsets.lower_bound(from); o != c.offsets.end(); ++o) {
      if (residual_of(o->first) > reach) break;
      const double residual = residual_of(o->first) / c.size;
      if (!best || residual < best->residual) best = Fit{k, true, o->first, residual};
    }
    if (!best && residual_of(span.mean) <= reach)
      best = Fit{k, false, span.mean, residual_of(span.mean) / c.size};
    return best;
  }

  Place place(int polygon) {
    const Shape& shape = shapes_[at(polygon)];
    std::vector<int> candidates;
    if (shape.normal && shape.uncertainty_rad <= angle_tolerance_) {
      candidates = near_classes(unit(*shape.normal));
    } else {
      candidates.resize(classes_.size());
      std::iota(candidates.begin(), candidates.end(), 0);
    }
    std::optional<Fit> best;
    for (const int k : candidates) {
      const auto here = fit(polygon, k);
      if (!here) continue;
      const auto key = [](const Fit& f) { return std::tuple(!f.is_known, f.residual); };
      if (!best || key(*here) < key(*best)) best = here;
    }
    if (!best) return place_in_own_class(polygon);
    classes_[at(best->normal_class)].offsets.emplace(best->offset, polygon);
    return {best->normal_class, best->offset};
  }

  Place place_in_own_class(int polygon) {
    NormalClass c;
    c.normal = shapes_[at(polygon)].normal.value_or(Normal{0, 0, 1});
    // One orientation for the class: the first component that is not zero is positive.
    const auto leading = std::ranges::find_if(c.normal, [](std::int64_t n) { return n != 0; });
    if (*leading < 0)
      for (auto& n : c.normal) n = -n;
    c.unit = unit(c.normal);
    c.size = length({static_cast<double>(c.normal[0]), static_cast<double>(c.normal[1]),
                     static_cast<double>(c.normal[2])});
    const std::int64_t offset = span_along(soup_, soup_.polygons[at(polygon)], c.normal).mean;
    c.offsets.emplace(offset, polygon);
    const int k = static_cast<int>(classes_.size());
    cells_[cell_of(c.unit)].push_back(k);
    classes_.push_back(std::move(c));
    return {k, offset};
  }

  /// Two parallel planes cannot share a vertex. Where polygons of one class but of two planes do,
  /// the smaller one takes its own normal, or the larger one's plane if that is no other. True if
  /// something changed.
  bool separate_parallels(const std::vector<int>& by_area) {
    std::vector<std::vector<int>> larger_at(soup_.points.size());
    bool has_changed = false;
    for (const int i : by_area) {
      const int rival = rival_of(i, larger_at);
      if (rival >= 0) {
        const Place& theirs = places_[at(rival)];
        const bool is_same_normal =
            !shapes_[at(i)].normal || own_class_exists(i, theirs.normal_class);
        places_[at(i)] = is_same_normal ? theirs : place_in_own_class(i);
        has_changed = true;
      }
      for (const auto& ring : soup_.polygons[at(i)].rings)
        for (const int v : ring) larger_at[at(v)].push_back(i);
    }
    return has_changed;
  }

  [[nodiscard]] bool own_class_exists(int polygon, int k) const {
    const Normal& own = *shapes_[at(polygon)].normal;
    const Normal& n = classes_[at(k)].normal;
    return own == n || own == Normal{-n[0], -n[1], -n[2]};
  }

  /// A larger polygon at a vertex of `polygon` on another plane of its class, or -1.
  [[nodiscard]] int rival_of(int polygon, const std::vector<std::vector<int>>& larger_at) const {
    const Place& mine = places_[at(polygon)];
    for (const auto& ring : soup_.polygons[at(polygon)].rings)
      for (const int v : ring)
        for (const int other : larger_at[at(v)]) {
          const Place& theirs = places_[at(other)];
          if (theirs.normal_class == mine.normal_class && theirs.offset != mine.offset)
            return other;
        }
    return -1;
  }

  /// Which way round the polygon lies on its plane.
  [[nodiscard]] bool is_flipped(int polygon) const {
    const Shape& shape = shapes_[at(polygon)];
    if (!shape.normal) return false;
    return dot(unit(*shape.normal), classes_[at(places_[at(polygon)].normal_class)].unit) < 0;
  }

  /// The polygon is so thin that it came to its plane although it is at more than 45° to it.
  [[nodiscard]] bool is_standing(int polygon) const {
    const Shape& shape = shapes_[at(polygon)];
    if (!shape.normal) return false;
    const Vec3 of_plane = classes_[at(places_[at(polygon)].normal_class)].unit;
    return std::abs(dot(unit(*shape.normal), of_plane)) < std::numbers::sqrt2 / 2;
  }

  /// Which way round each polygon lies on its plane; what stands across it goes with the neighbours
  /// that it shares most of its outline with. Counts them.
  [[nodiscard]] std::vector<char> ways_round(int& standing) const {
    std::vector<char> flipped(soup_.polygons.size());
    std::vector<int> undecided;
    for (int i = 0; i < std::ssize(soup_.polygons); ++i) {
      flipped[at(i)] = is_flipped(i);
      if (is_standing(i)) undecided.push_back(i);
    }
    standing = static_cast<int>(undecided.size());
    if (undecided.empty()) return flipped;

    std::map<std::pair<int, int>, std::vector<int>> polygons_at;
    for_each_edge([&](int i, std::pair<int, int> edge) { polygons_at[edge].push_back(i); });
    std::vector<double> votes(soup_.polygons.size(), 0);
    for_each_edge([&](int i, std::pair<int, int> edge) {
      for (const int j : polygons_at.at(edge))
        if (j != i && places_[at(j)] == places_[at(i)] && !is_standing(j))
          votes[at(i)] += (flipped[at(j)] ? -1 : 1) * edge_length(edge);
    });
    for (const int i : undecided)
      if (votes[at(i)] != 0) flipped[at(i)] = votes[at(i)] < 0;
    return flipped;
  }

  /// Visits the edges of all polygons, smaller point first.
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for (int i = 0; i < std::ssize(soup_.polygons); ++i)
      for (const auto& ring : soup_.polygons[at(i)].rings)
        for (std::size_t k = 0; k < ring.size(); ++k)
          visit(i, std::minmax({ring[k], ring[(k + 1) % ring.size()]}));
  }

  [[nodiscard]] double edge_length(std::pair<int, int> edge) const {
    const auto &p = soup_.points[at(edge.first)], &q = soup_.points[at(edge.second)];
    return length({static_cast<double>(p[0] - q[0]), static_cast<double>(p[1] - q[1]),
                   static_cast<double>(p[2] - q[2])});
  }

  [[nodiscard]] PlaneClusters result() const {
    std::map<std::tuple<int, std::int64_t, bool>, int> ids;
    std::vector<Plane> planes;
    std::vector<int> plane_of(soup_.polygons.size());
    PlaneClusters out;
    const std::vector<char> is_turned = ways_round(out.standing);
    for (int i = 0; i < std::ssize(soup_.polygons); ++i) {
      const Place& p = places_[at(i)];
      const bool flipped = is_turned[at(i)] != 0;
      const auto [entry, is_new] = ids.emplace(std::tuple(p.normal_class, p.offset, flipped),
                                               static_cast<int>(planes.size()));
      if (is_new) {
        const Plane plane =
            exact::make_plane(classes_[at(p.normal_class)].normal, p.offset, soup_.grid_m);
        planes.push_back(flipped ? exact::opposite(plane) : plane);
      }
      plane_of[at(i)] = entry->second;
    }
    std::vector<int> order(planes.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, std::greater{}, [&](int i) {
      const Plane& p = planes[at(i)];
      return std::tuple(p.normal.x, p.normal.y, p.normal.z, p.offset_m);
    });
    std::vector<int> place_of(planes.size());
    for (const int i : order) {
      place_of[at(i)] = static_cast<int>(out.planes.size());
      out.planes.push_back(planes[at(i)]);
    }
    for (const int p : plane_of) out.plane_of.push_back(place_of[at(p)]);
    return out;
  }

  const Soup& soup_;
  double offset_tolerance_;  ///< grid units
  double angle_tolerance_;
  std::vector<Shape> shapes_;
  std::vector<NormalClass> classes_;
  std::unordered_map<Cell, std::vector<int>, CellHash> cells_;
  std::vector<Place> places_;
};

}  // namespace

PlaneClusters cluster_planes(const Soup& soup, const Tolerances& tolerances) {
  return Clusterer(soup, tolerances).run();
}

}  // namespace oriel::detail
