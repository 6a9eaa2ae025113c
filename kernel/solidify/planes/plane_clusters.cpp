#include "kernel/solidify/planes/plane_clusters.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/solidify/planes/coplanar_groups.h"
#include "kernel/solidify/planes/known_planes.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"
#include "model/description/counting_sort.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <ranges>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

/// A polygon is so thin that it came to its plane although it is at more than 45 degrees to it:
/// `cosine` is that between the two normals.
inline bool is_standing(double cosine) { return std::abs(cosine) < std::numbers::sqrt2 / 2; }

/// Which way round polygons lie on their planes.
struct WaysRound {
  /// By polygon: the plane's normal is to be turned for it.
  std::vector<char> is_turned;
  /// So many stand across their planes.
  int standing = 0;
};

template <class Visit>
void for_each_edge(const Soup& soup, int polygon, Visit visit) {
  for (const int r : soup.rings_of(polygon)) {
    const auto ring = soup.ring(r);
    for (std::size_t k = 0; k < ring.size(); ++k)
      visit(PointPair(std::minmax({ring[k], ring[(k + 1) % ring.size()]})));
  }
}

double edge_length(const Soup& soup, PointPair edge) {
  const auto &p = soup.points[at(edge.first)], &q = soup.points[at(edge.second)];
  return length({static_cast<double>(p[0] - q[0]), static_cast<double>(p[1] - q[1]),
                 static_cast<double>(p[2] - q[2])});
}

/// The polygons at the edges of those that are undecided.
std::map<PointPair, std::vector<int>> polygons_beside(const Soup& soup,
                                                      std::span<const int> undecided) {
  std::vector<char> is_near(soup.points.size(), 0);
  for (const int i : undecided)
    for (const int v : soup.corners_of(i)) is_near[at(v)] = 1;
  std::map<PointPair, std::vector<int>> polygons_at;
  for (int i = 0; i < soup.polygon_count(); ++i)
    for_each_edge(soup, i, [&](PointPair edge) {
      if (is_near[at(edge.first)] && is_near[at(edge.second)]) polygons_at[edge].push_back(i);
    });
  return polygons_at;
}

void decide_standing(const Soup& soup, std::span<const double> cosines, std::span<const int> planes,
                     std::span<const int> undecided, std::vector<char>& is_turned) {
  const auto polygons_at = polygons_beside(soup, undecided);
  std::vector<double> votes(soup.polygons.size(), 0);
  for (const int i : undecided)
    for_each_edge(soup, i, [&](PointPair edge) {
      for (const int j : polygons_at.at(edge))
        if (j != i && planes[at(j)] == planes[at(i)] && !is_standing(cosines[at(j)]))
          votes[at(i)] += (is_turned[at(j)] ? -1 : 1) * edge_length(soup, edge);
    });
  for (const int i : undecided)
    if (votes[at(i)] != 0) is_turned[at(i)] = votes[at(i)] < 0;
}

/// What stands across its plane goes with the neighbours on the same plane that it shares most of
/// its outline with. `cosines`: by polygon, between its normal and its plane's; `planes`: by
/// polygon, the number of its plane, of which the way round is asked.
WaysRound ways_round(const Soup& soup, std::span<const double> cosines,
                     std::span<const int> planes) {
  WaysRound out;
  out.is_turned.resize(soup.polygons.size());
  std::vector<int> undecided;
  for (int i = 0; i < std::ssize(out.is_turned); ++i) {
    out.is_turned[at(i)] = cosines[at(i)] < 0;
    if (is_standing(cosines[at(i)])) undecided.push_back(i);
  }
  out.standing = static_cast<int>(undecided.size());
  if (!undecided.empty()) decide_standing(soup, cosines, planes, undecided, out.is_turned);
  return out;
}

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
            Work& work, std::vector<char> is_united = {})
      : soup_(soup),
        work_(work),
        is_united_(std::move(is_united)),
        offset_tolerance_(tolerances.plane_offset_m / soup.grid_m),
        angle_tolerance_(tolerances.coplanar_deg * std::numbers::pi / 180),
        shapes_(std::move(shapes)),
        planes_(angle_tolerance_, (1 + kRounds) * shapes_.size()) {}

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
    const std::vector<int> crowded = crowded_polygons(by_area);
    for (int round = 0; round < kRounds && separate_parallels(crowded); ++round) {
    }
    return result();
  }

 private:
  /// So often parallels are separated at most.
  static constexpr int kRounds = 3;

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
    const IntegerNormal normal = unoriented(*shape.normal);
    const auto offset = offset_if_flat(soup_, polygon, normal);
    return offset ? planes_.exact_place(normal, *offset) : -1;
  }

  /// `uncertainty` is the polygon's.
  [[nodiscard]] bool is_tilted_too_far(const PolygonShape& shape, double uncertainty,
                                       const PlaneClass& c) const {
    const double allowed = angle_tolerance_ + uncertainty;
    if (!shape.normal || allowed >= std::numbers::pi / 2) return false;
    return is_arcsine_above(length(cross(shape.unit, c.unit)), allowed);
  }

  /// The best place for the polygon in one class, if there is one.
  [[nodiscard]] std::optional<PlaneFit> fit(int polygon, double uncertainty, int k) const {
    const PlaneClass& c = planes_.classes()[at(k)];
    if (is_tilted_too_far(shapes_[at(polygon)], uncertainty, c)) return std::nullopt;
    const OffsetSpan span = span_along(soup_, polygon, c.normal);
    if (const auto known = planes_.known_fit(k, span, offset_tolerance_)) return known;
    const std::int64_t middle = middle_along(polygon, c.normal, span);
    const double residual = residual_of(span, middle);
    if (residual > offset_tolerance_ * c.size) return std::nullopt;
    return PlaneFit{k, false, middle, residual / c.size};
  }

  /// The offset of the polygon's own plane of that normal.
  [[nodiscard]] std::int64_t middle_along(int polygon, const IntegerNormal& normal,
                                          const OffsetSpan& span) const {
    return is_united_.empty() || !is_united_[at(polygon)] ? span.mean
                                                          : median_along(soup_, polygon, normal);
  }

  /// Puts the polygon on the best place there is, or on a new one; returns its number.
  int place(int polygon) {
    if (work_.is_used_up()) return place_in_own_class(polygon);
    const PolygonShape& shape = shapes_[at(polygon)];
    const double uncertainty =
        uncertainty_rad(height_of(soup_, polygon, shape.area), offset_tolerance_);
    std::optional<PlaneFit> best;
    const auto try_class = [&](int k) {
      work_.add(std::ssize(soup_.corners_of(polygon)));
      if (work_.is_used_up()) return false;
      const auto here = fit(polygon, uncertainty, k);
      const auto key = [](const PlaneFit& f) { return std::tuple(!f.is_known, f.residual); };
      if (here && (!best || key(*here) < key(*best))) best = here;
      return true;
    };
    if (shape.normal && uncertainty <= angle_tolerance_)
      std::ranges::all_of(planes_.near_classes(shape.unit), try_class);
    else
      std::ranges::all_of(std::views::iota(0, static_cast<int>(planes_.classes().size())),
                          try_class);
    return best ? planes_.number_of(best->normal_class, best->offset) : place_in_own_class(polygon);
  }

  int place_in_own_class(int polygon) {
    const IntegerNormal normal =
        unoriented(shapes_[at(polygon)].normal.value_or(IntegerNormal{0, 0, 1}));
    const int k = planes_.add_class(normal);
    return planes_.number_of(k, middle_along(polygon, normal, span_along(soup_, polygon, normal)));
  }

  /// The polygons that meet another one of their class at a point: only they can be too many there,
  /// as no polygon joins a class later. Classes are told apart by their numbers' last bits: a
  /// polygon too many does no harm.
  [[nodiscard]] std::vector<int> crowded_polygons(std::span<const int> by_area) const {
    const auto bit_of = [&](int polygon) {
      constexpr int kBits = 64;
      return std::uint64_t{1} << (class_of(place_of_[at(polygon)]) % kBits);
    };
    std::vector<std::uint64_t> met(soup_.points.size(), 0), met_again(met);
    std::uint64_t any_again = 0;
    const int count = soup_.polygon_count();
    for (int i = 0; i < count; ++i) {
      const std::uint64_t bit = bit_of(i);
      for (const int v : soup_.corners_of(i)) {
        const std::uint64_t again = met[at(v)] & bit;
        met[at(v)] |= bit;
        if (again == 0) continue;
        met_again[at(v)] |= bit;
        any_again |= bit;
      }
    }
    std::vector<int> crowded;
    if (any_again == 0) return crowded;
    std::ranges::copy_if(by_area, std::back_inserter(crowded), [&](int i) {
      const std::uint64_t bit = any_again & bit_of(i);
      return bit != 0 && std::ranges::any_of(soup_.corners_of(i),
                                             [&](int v) { return (met_again[at(v)] & bit) != 0; });
    });
    return crowded;
  }

  /// Two parallel planes cannot share a vertex. Where polygons of one class but of two planes do,
  /// the smaller one takes its own normal, or the larger one's plane if that is no other. True if
  /// something changed. `crowded`: the largest first.
  bool separate_parallels(std::span<const int> crowded) {
    if (crowded.empty()) return false;
    PlacesAtPoints of_larger(soup_);
    bool has_changed = false;
    std::vector<int> points;  // where the polygon's place is new
    for (const int i : crowded) {
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

  [[nodiscard]] int class_of(int place) const { return planes_.places()[at(place)].normal_class; }

  [[nodiscard]] bool own_class_exists(int polygon, int k) const {
    const IntegerNormal& own = *shapes_[at(polygon)].normal;
    const IntegerNormal& n = planes_.classes()[at(k)].normal;
    return own == n || own == IntegerNormal{-n[0], -n[1], -n[2]};
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

  /// The cosines between the normals of polygons and of their planes' classes; 1 for a polygon
  /// without area.
  [[nodiscard]] std::vector<double> cosines_to_classes() const {
    std::vector<double> cosines(shapes_.size(), 1);
    for (std::size_t i = 0; i < shapes_.size(); ++i)
      if (shapes_[i].normal) cosines[i] = dot(shapes_[i].unit, planes_.class_at(place_of_[i]).unit);
    return cosines;
  }

  [[nodiscard]] PlaneClusters result() const {
    std::vector<int> plane_at(2 * planes_.places().size(), -1);  // by place and way round
    std::vector<Plane> planes;
    std::vector<int> plane_of(soup_.polygons.size());
    PlaneClusters out;
    const WaysRound ways = ways_round(soup_, cosines_to_classes(), place_of_);
    out.standing = ways.standing;
    for (int i = 0; i < soup_.polygon_count(); ++i) {
      const int place = place_of_[at(i)];
      const bool flipped = ways.is_turned[at(i)] != 0;
      int& number = plane_at[2 * at(place) + (flipped ? 1 : 0)];
      if (number < 0) {
        number = static_cast<int>(planes.size());
        const Plane plane = exact::make_plane(planes_.class_at(place).normal,
                                              planes_.places()[at(place)].offset, soup_.grid_m);
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
    out.planes.reserve(planes.size());
    for (const int i : order) {
      place_of[at(i)] = static_cast<int>(out.planes.size());
      out.planes.push_back(planes[at(i)]);
    }
    for (int& p : plane_of) p = place_of[at(p)];
    out.plane_of = std::move(plane_of);
    return out;
  }

  const Soup& soup_;
  Work& work_;
  std::vector<char> is_united_;
  double offset_tolerance_;  ///< grid units
  double angle_tolerance_;
  std::vector<PolygonShape> shapes_;
  KnownPlanes planes_;
  std::vector<int> place_of_;  ///< by polygon
};

/// Members of groups that are at more than 45° to their group's plane: all there is to tell of a
/// recess or a rise that went into its wall.
int count_standing(std::span<const PolygonShape> shapes, const CoplanarGroups& groups,
                   const PlaneClusters& of_groups) {
  int standing = 0;
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    const auto group = static_cast<std::size_t>(groups.group_of[p]);
    const Plane& plane = of_groups.planes[static_cast<std::size_t>(of_groups.plane_of[group])];
    const PolygonShape& shape = shapes[p];
    if (shape.normal && is_standing(dot(shape.unit, plane.normal))) ++standing;
  }
  return standing;
}

}  // namespace

PlaneClusters cluster_planes(const Soup& soup, const ShellMesh& mesh, const Tolerances& tolerances,
                             Work& work) {
  ORIEL_ASSERT(mesh.twin.size() == soup.corners.size(), "the mesh is of another soup");
  std::vector<PolygonShape> shapes = shapes_of(soup);
  const std::optional<CoplanarGroups> found = group_coplanar(soup, shapes, mesh, tolerances, work);
  if (!found) return Clusterer(soup, std::move(shapes), tolerances, work).run();
  const CoplanarGroups& groups = *found;
  const Soup grouped = soup_of_groups(soup, groups);
  std::vector<int> members(static_cast<std::size_t>(groups.count), 0);
  for (const int g : groups.group_of) ++members[static_cast<std::size_t>(g)];
  std::vector<char> is_united;
  for (const int n : members) is_united.push_back(n > 1);
  Clusterer clusterer(grouped, shapes_of(grouped), tolerances, work, std::move(is_united));
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
