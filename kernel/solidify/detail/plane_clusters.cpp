#include "kernel/solidify/detail/plane_clusters.h"

#include "kernel/model/detail/counting_sort.h"
#include "kernel/model/detail/index.h"
#include "kernel/solidify/detail/coplanar_groups.h"
#include "kernel/solidify/detail/polygon_shape.h"

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

/// The normal or its negative: its first component that is not zero is positive.
Normal unoriented(const Normal& normal) {
  return normal < Normal{0, 0, 0} ? Normal{-normal[0], -normal[1], -normal[2]} : normal;
}

/// A cell of the grid in which unit normals lie.
using Cell = std::array<int, 3>;

/// Planes of one direction.
struct NormalClass {
  Normal normal{};
  Vec3 unit;
  Cell cell{};
  double size = 0;
  std::map<std::int64_t, int> offsets;  ///< normal · point, and the number of the place
};

/// A place for a polygon: a class, and a plane of it or a new offset.
struct Fit {
  int normal_class = -1;
  bool is_known = false;
  std::int64_t offset = 0;
  double residual = 0;
};

/// Keys for hashing: three numbers, or three and an offset.
struct CellHash {
  template <class Cell>
  std::size_t operator()(const Cell& cell) const noexcept {
    std::uint64_t h = 0;
    for (const auto c : cell) {
      h = (h ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
      h ^= h >> 32;
    }
    return h;
  }
};

/// The places met at every point, each once, in the order in which they came.
class PlacesAtPoints {
 public:
  explicit PlacesAtPoints(const Soup& soup) : end_(soup.points.size() + 1, 0) {
    for (const int v : soup.corners) ++end_[index(v)];
    count_to_first(end_);
    first_ = end_;
    places_.resize(soup.corners.size());
  }

  [[nodiscard]] std::span<const int> at(int point) const {
    return {places_.data() + first_[index(point)], places_.data() + end_[index(point)]};
  }
  void add(int point, int place) { places_[index(end_[index(point)]++)] = place; }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  Numbers first_, end_, places_;
};

class Clusterer {
 public:
  /// `shapes` of the polygons; `is_united`: of each whether it is several in one; none are if it is
  /// empty.
  Clusterer(const Soup& soup, std::vector<PolygonShape> shapes, const Tolerances& tolerances,
            std::vector<char> is_united = {})
      : soup_(soup),
        is_united_(std::move(is_united)),
        offset_tolerance_(tolerances.plane_offset_m / soup.grid_m),
        angle_tolerance_(tolerances.coplanar_deg * std::numbers::pi / 180),
        shapes_(std::move(shapes)) {}

  /// Another normal for a polygon than that of its area vector.
  void set_normal(int polygon, Vec3 normal) {
    PolygonShape& shape = shapes_[at(polygon)];
    const double scale = static_cast<double>(exact::kMaxNormal) / 2;
    const auto whole = [&](double c) { return exact::Int128{std::llround(scale * c)}; };
    shape.normal =
        exact::direction(exact::Vector128{whole(normal.x), whole(normal.y), whole(normal.z)});
    shape.unit = unit(*shape.normal);
  }

  PlaneClusters run() {
    const std::vector<int> by_area = largest_first();
    place_of_.resize(soup_.polygons.size());
    for (const int i : by_area) {
      const int known = exact_place(i);
      place_of_[at(i)] = known >= 0 ? known : place(i);
    }
    for (int round = 0; round < 3 && separate_parallels(by_area); ++round) {
    }
    return result();
  }

 private:
  /// A plane that polygons were put on.
  struct Place {
    int normal_class = -1;
    std::int64_t offset = 0;
  };
  using ExactPlane = std::array<std::int64_t, 4>;  ///< normal and offset

  [[nodiscard]] double cell_size() const {
    return std::max(2 * std::sin(angle_tolerance_ / 2), 1e-9 /* tolerance 0 */);
  }

  [[nodiscard]] Cell cell_of(Vec3 u) const {
    const double size = cell_size();
    return {static_cast<int>(std::floor(u.x / size)), static_cast<int>(std::floor(u.y / size)),
            static_cast<int>(std::floor(u.z / size))};
  }

  [[nodiscard]] std::vector<int> largest_first() const {
    struct Sized {
      double area;
      int polygon;
    };
    std::vector<Sized> sized;
    sized.reserve(shapes_.size());
    for (const PolygonShape& shape : shapes_)
      sized.push_back({shape.area, static_cast<int>(sized.size())});
    std::ranges::stable_sort(sized, std::greater{}, &Sized::area);
    std::vector<int> order;
    order.reserve(sized.size());
    for (const Sized& s : sized) order.push_back(s.polygon);
    return order;
  }

  /// The place that has the polygon's own normal and all its vertices exactly, or -1. No other one
  /// would fit better, so most polygons need not be tried with all classes near theirs.
  [[nodiscard]] int exact_place(int polygon) const {
    const PolygonShape& shape = shapes_[at(polygon)];
    if (!shape.normal) return -1;
    const Normal normal = unoriented(*shape.normal);
    const auto offset = offset_if_flat(soup_, polygon, normal);
    if (!offset) return -1;
    const auto found = exact_places_.find({normal[0], normal[1], normal[2], *offset});
    return found != exact_places_.end() ? found->second : -1;
  }

  /// The number of a place; it is made if there is none yet.
  int number_of(int k, std::int64_t offset) {
    NormalClass& c = classes_[at(k)];
    const auto [entry, is_new] = c.offsets.emplace(offset, static_cast<int>(places_.size()));
    if (!is_new) return entry->second;
    places_.push_back({k, offset});
    // Of classes with one normal the first one's place is the one that polygons take.
    int& exact =
        exact_places_.try_emplace({c.normal[0], c.normal[1], c.normal[2], offset}, entry->second)
            .first->second;
    if (k < places_[at(exact)].normal_class) exact = entry->second;
    return entry->second;
  }

  static bool is_next_to(const Cell& a, const Cell& b) {
    return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
  }

  /// Classes whose normal may be within the tolerance of ±`u`.
  [[nodiscard]] std::vector<int> near_classes(Vec3 u) const {
    std::vector<int> found;
    if (classes_.size() < 27) {  // fewer than there are cells to look into
      for (std::size_t k = 0; k < classes_.size(); ++k)
        if (is_next_to(cell_of(u), classes_[k].cell) || is_next_to(cell_of(-u), classes_[k].cell))
          found.push_back(static_cast<int>(k));
      return found;
    }
    for (const Vec3 v : {u, -u}) {
      const auto [x, y, z] = cell_of(v);
      if (x < -1) continue;  // the normals of classes have x ≥ 0
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

  /// `uncertainty` is the polygon's.
  [[nodiscard]] bool is_tilted_too_far(const PolygonShape& shape, double uncertainty,
                                       const NormalClass& c) const {
    const double allowed = angle_tolerance_ + uncertainty;
    if (!shape.normal || allowed >= std::numbers::pi / 2) return false;
    return is_arcsine_above(length(cross(shape.unit, c.unit)), allowed);
  }

  /// The best place for the polygon in one class, if there is one.
  [[nodiscard]] std::optional<Fit> fit(int polygon, double uncertainty, int k) const {
    const NormalClass& c = classes_[at(k)];
    if (is_tilted_too_far(shapes_[at(polygon)], uncertainty, c)) return std::nullopt;
    const Span span = span_along(soup_, polygon, c.normal);
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
    if (best) return best;
    const std::int64_t middle = middle_along(polygon, c.normal, span);
    if (residual_of(middle) <= reach) best = Fit{k, false, middle, residual_of(middle) / c.size};
    return best;
  }

  /// The offset of the polygon's own plane of that normal.
  [[nodiscard]] std::int64_t middle_along(int polygon, const Normal& normal,
                                          const Span& span) const {
    return is_united_.empty() || !is_united_[at(polygon)] ? span.mean
                                                          : median_along(soup_, polygon, normal);
  }

  /// Puts the polygon on the best place there is, or on a new one; returns its number.
  int place(int polygon) {
    const PolygonShape& shape = shapes_[at(polygon)];
    const double uncertainty = shape.uncertainty_rad(offset_tolerance_);
    std::vector<int> candidates;
    if (shape.normal && uncertainty <= angle_tolerance_) {
      candidates = near_classes(shape.unit);
    } else {
      candidates.resize(classes_.size());
      std::iota(candidates.begin(), candidates.end(), 0);
    }
    std::optional<Fit> best;
    for (const int k : candidates) {
      const auto here = fit(polygon, uncertainty, k);
      if (!here) continue;
      const auto key = [](const Fit& f) { return std::tuple(!f.is_known, f.residual); };
      if (!best || key(*here) < key(*best)) best = here;
    }
    return best ? number_of(best->normal_class, best->offset) : place_in_own_class(polygon);
  }

  int place_in_own_class(int polygon) {
    NormalClass c;
    c.normal = unoriented(shapes_[at(polygon)].normal.value_or(Normal{0, 0, 1}));
    c.unit = unit(c.normal);
    c.size = length({static_cast<double>(c.normal[0]), static_cast<double>(c.normal[1]),
                     static_cast<double>(c.normal[2])});
    const int k = static_cast<int>(classes_.size());
    c.cell = cell_of(c.unit);
    cells_[c.cell].push_back(k);
    classes_.push_back(std::move(c));
    const Normal& normal = classes_.back().normal;
    return number_of(k, middle_along(polygon, normal, span_along(soup_, polygon, normal)));
  }

  /// Two parallel planes cannot share a vertex. Where polygons of one class but of two planes do,
  /// the smaller one takes its own normal, or the larger one's plane if that is no other. True if
  /// something changed.
  bool separate_parallels(const std::vector<int>& by_area) {
    PlacesAtPoints of_larger(soup_);
    bool has_changed = false;
    std::vector<int> points;  // where the polygon's place is new
    for (const int i : by_area) {
      const int rival = rival_of(i, of_larger, points);
      if (rival >= 0) {
        const bool is_same_normal = !shapes_[at(i)].normal || own_class_exists(i, class_of(rival));
        place_of_[at(i)] = is_same_normal ? rival : place_in_own_class(i);
        has_changed = true;
        rival_of(i, of_larger, points);  // for the points at which the new place is new
      }
      for (const int v : points) of_larger.add(v, place_of_[at(i)]);
    }
    return has_changed;
  }

  [[nodiscard]] int class_of(int place) const { return places_[at(place)].normal_class; }

  [[nodiscard]] bool own_class_exists(int polygon, int k) const {
    const Normal& own = *shapes_[at(polygon)].normal;
    const Normal& n = classes_[at(k)].normal;
    return own == n || own == Normal{-n[0], -n[1], -n[2]};
  }

  /// The place of a larger polygon at a vertex of `polygon`, on another plane of its class; or -1.
  /// `points`: its vertices at which no larger polygon has its place.
  int rival_of(int polygon, const PlacesAtPoints& of_larger, std::vector<int>& points) const {
    points.clear();
    const int mine = place_of_[at(polygon)], my_class = class_of(mine);
    int rival = -1;
    for (const int v : soup_.corners_of(polygon)) {
      bool is_new = true;
      for (const int theirs : of_larger.at(v)) {
        if (theirs == mine)
          is_new = false;
        else if (rival < 0 && class_of(theirs) == my_class)
          rival = theirs;
      }
      if (is_new) points.push_back(v);
    }
    return rival;
  }

  /// The cosine between the normals of a polygon and of its plane's class; 1 for a polygon without
  /// area.
  [[nodiscard]] double cosine_to_class(int polygon) const {
    const PolygonShape& shape = shapes_[at(polygon)];
    const NormalClass& c = classes_[at(places_[at(place_of_[at(polygon)])].normal_class)];
    return shape.normal ? dot(shape.unit, c.unit) : 1;
  }

  /// The polygon is so thin that it came to its plane although it is at more than 45° to it.
  static bool is_standing(double cosine) { return std::abs(cosine) < std::numbers::sqrt2 / 2; }

  /// Which way round each polygon lies on its plane; what stands across it goes with the neighbours
  /// that it shares most of its outline with. Counts them.
  [[nodiscard]] std::vector<char> ways_round(int& standing) const {
    std::vector<char> flipped(soup_.polygons.size());
    std::vector<int> undecided;
    for (int i = 0; i < soup_.polygon_count(); ++i) {
      const double cosine = cosine_to_class(i);
      flipped[at(i)] = cosine < 0;
      if (is_standing(cosine)) undecided.push_back(i);
    }
    standing = static_cast<int>(undecided.size());
    if (!undecided.empty()) decide_standing(undecided, flipped);
    return flipped;
  }

  using Edge = std::pair<int, int>;  ///< points, the smaller one first

  void decide_standing(const std::vector<int>& undecided, std::vector<char>& flipped) const {
    std::vector<char> is_near(soup_.points.size(), 0);
    for (const int i : undecided)
      for (const int v : soup_.corners_of(i)) is_near[at(v)] = 1;
    std::map<Edge, std::vector<int>> polygons_at;
    for (int i = 0; i < soup_.polygon_count(); ++i)
      for_each_edge(i, [&](Edge edge) {
        if (is_near[at(edge.first)] && is_near[at(edge.second)]) polygons_at[edge].push_back(i);
      });
    std::vector<double> votes(soup_.polygons.size(), 0);
    for (const int i : undecided)
      for_each_edge(i, [&](Edge edge) {
        for (const int j : polygons_at.at(edge))
          if (j != i && place_of_[at(j)] == place_of_[at(i)] && !is_standing(cosine_to_class(j)))
            votes[at(i)] += (flipped[at(j)] ? -1 : 1) * edge_length(edge);
      });
    for (const int i : undecided)
      if (votes[at(i)] != 0) flipped[at(i)] = votes[at(i)] < 0;
  }

  template <class Visit>
  void for_each_edge(int polygon, Visit visit) const {
    for (const int r : soup_.rings_of(polygon)) {
      const auto ring = soup_.ring(r);
      for (std::size_t k = 0; k < ring.size(); ++k)
        visit(Edge(std::minmax({ring[k], ring[(k + 1) % ring.size()]})));
    }
  }

  [[nodiscard]] double edge_length(Edge edge) const {
    const auto &p = soup_.points[at(edge.first)], &q = soup_.points[at(edge.second)];
    return length({static_cast<double>(p[0] - q[0]), static_cast<double>(p[1] - q[1]),
                   static_cast<double>(p[2] - q[2])});
  }

  [[nodiscard]] PlaneClusters result() const {
    std::vector<int> plane_at(2 * places_.size(), -1);  // by place and way round
    std::vector<Plane> planes;
    std::vector<int> plane_of(soup_.polygons.size());
    PlaneClusters out;
    const std::vector<char> is_turned = ways_round(out.standing);
    for (int i = 0; i < soup_.polygon_count(); ++i) {
      const int place = place_of_[at(i)];
      const bool flipped = is_turned[at(i)] != 0;
      int& number = plane_at[2 * at(place) + (flipped ? 1 : 0)];
      if (number < 0) {
        number = static_cast<int>(planes.size());
        const Place& p = places_[at(place)];
        const Plane plane =
            exact::make_plane(classes_[at(p.normal_class)].normal, p.offset, soup_.grid_m);
        planes.push_back(flipped ? exact::opposite(plane) : plane);
      }
      plane_of[at(i)] = number;
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
  std::vector<char> is_united_;
  double offset_tolerance_;  ///< grid units
  double angle_tolerance_;
  std::vector<PolygonShape> shapes_;
  std::vector<NormalClass> classes_;
  std::unordered_map<Cell, std::vector<int>, CellHash> cells_;  ///< classes by unit normal
  std::vector<Place> places_;
  std::unordered_map<ExactPlane, int, CellHash> exact_places_;
  std::vector<int> place_of_;  ///< by polygon
};

/// Members of groups that are at more than 45° to their group's plane: all there is to tell of a
/// recess or a rise that went into its wall.
int count_standing(const std::vector<PolygonShape>& shapes, const CoplanarGroups& groups,
                   const PlaneClusters& of_groups) {
  int standing = 0;
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    const auto group = static_cast<std::size_t>(groups.group_of[p]);
    const Plane& plane = of_groups.planes[static_cast<std::size_t>(of_groups.plane_of[group])];
    const PolygonShape& shape = shapes[p];
    if (shape.normal && std::abs(dot(shape.unit, plane.normal)) < std::numbers::sqrt2 / 2)
      ++standing;
  }
  return standing;
}

}  // namespace

PlaneClusters cluster_planes(const Soup& soup, const ShellMesh& mesh,
                             const Tolerances& tolerances) {
  std::vector<PolygonShape> shapes = shapes_of(soup);
  const CoplanarGroups groups = group_coplanar(soup, shapes, mesh, tolerances);
  if (groups.count == soup.polygon_count())
    return Clusterer(soup, std::move(shapes), tolerances).run();
  const Soup grouped = soup_of_groups(soup, groups);
  std::vector<int> members(static_cast<std::size_t>(groups.count), 0);
  for (const int g : groups.group_of) ++members[static_cast<std::size_t>(g)];
  std::vector<char> is_united;
  for (const int n : members) is_united.push_back(n > 1);
  Clusterer clusterer(grouped, shapes_of(grouped), tolerances, std::move(is_united));
  for (int g = 0; g < groups.count; ++g)
    if (const auto& normal = groups.fitted_normal[static_cast<std::size_t>(g)])
      clusterer.set_normal(g, *normal);
  PlaneClusters clusters = clusterer.run();
  clusters.standing = count_standing(shapes, groups, clusters);
  std::vector<int> plane_of;
  plane_of.reserve(groups.group_of.size());
  for (const int g : groups.group_of)
    plane_of.push_back(clusters.plane_of[static_cast<std::size_t>(g)]);
  clusters.plane_of = std::move(plane_of);
  return clusters;
}

}  // namespace oriel::detail
