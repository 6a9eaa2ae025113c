#include "kernel/segment/planes/points.h"

#include "kernel/base/assert.h"
#include "kernel/geometry/axis_corners.h"
#include "model/description/counting_sort.h"

#include <algorithm>
#include <cmath>
#include <ranges>

namespace oriel::detail {

namespace {

/// Doubles of points and planes are right to some 1e-12 m within the 4 km that the grid allows: a
/// signed distance beyond this is certain, and below it the exact test decides. Not a tolerance: it
/// changes no answer.
constexpr double kCertain_m = 1e-9;  // tolerance of doubles

/// weld_m in grid units, at least: vertices closer than that are one, so are meetings.
constexpr double kGridsPerWeld = 1024;

/// As near as the meeting of three planes comes to a segment that it lies on, in doubles.
constexpr double kOnSegment_m = 1e-10;

bool is_on_segment(Vec3 p, Vec3 from, Vec3 along) {
  const double t = dot(p - from, along) / dot(along, along);
  return t >= 0 && t <= 1 && length(p - (from + t * along)) <= kOnSegment_m;
}

}  // namespace

PointTable::PointTable(const Solid& solid, const PlaneTable& planes, Work& work)
    : grid_m_(solid.grid_m),
      near_m_(solid.grid_m * kGridsPerWeld),
      planes_(planes),
      work_(work),
      points_(solid.vertices.size()),
      ranks_(index(planes.class_count())) {
  list_planes(solid.facets);
  AxisCorners corners(grid_m_);
  corners.reserve(index(planes.size()));
  for (int p = 0; p < planes.size(); ++p) corners.add(planes.plane(p));
  places_.reserve(points_.size());
  for (const PointId p : points_.ids()) {
    TablePoint& point = points_[p];
    const Vertex& vertex = solid.vertices[p.index()];
    const Vec3 at = vertex.point;
    std::optional<Vec3> where;
    if (vertex.is_meeting && point.planes.size() >= 3) {
      where = corners.meeting(point.planes[0], point.planes[1], point.planes[2]);
      if (!where) where = meeting_of(point);
    }
    point.is_rounded = !where || length(*where - at) > kOnSegment_m;
    if (!point.is_rounded) {
      places_.push_back(*where);
      continue;
    }
    const ExactPlace place = place_at(exact::round_finely(at, grid_m_));
    places_.push_back(place.at);
    point.stored = static_cast<int>(exact_.size());
    exact_.push_back(place.where);
  }
  solid_points_ = size();
}

/// Where its first three planes meet.
std::optional<Vec3> PointTable::meeting_of(const TablePoint& point) const {
  const auto plane = [&](std::size_t i) -> const Plane& { return planes_.plane(point.planes[i]); };
  const auto where = exact::meet(plane(0), plane(1), plane(2));
  return where ? std::optional(metres_of(*where)) : std::nullopt;
}

/// Enters in every point its planes, sorted, each once: the facets come plane by plane.
void PointTable::list_planes(std::span<const Facet> facets) {
  Numbers plane_of(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f)
    plane_of[f] = planes_.side_of(facets[f].plane) >> 1;
  for (const int f : sort_into_buckets(plane_of, index(planes_.size())).items) {
    const int plane = plane_of[index(f)];
    for (const Loop& loop : facets[index(f)].loops)
      for (const int v : loop) {
        auto& planes = points_[PointId{v}].planes;
        if (planes.empty() || planes.back() != plane) planes.push_back(plane);
      }
  }
}

Vec3 PointTable::metres_of(const exact::Rational& where) const {
  const auto grid = exact::as_grid_point(where);
  return grid ? exact::to_metres(*grid, grid_m_) : exact::to_metres(where, grid_m_);
}

exact::Rational PointTable::exact_at(PointId p) const {
  const TablePoint& point = points_[p];
  if (point.stored >= 0) return exact_[index(point.stored)];
  const auto plane = [&](std::size_t i) { return planes_.plane(point.planes[i]); };
  return *exact::meet(plane(0), plane(1), plane(2));
}

int PointTable::exact_side(const exact::Rational& point, int plane) const {
  const auto grid = exact::as_grid_point(point);
  return grid ? exact::side(planes_.plane(plane), *grid) : exact::side(planes_.plane(plane), point);
}

int PointTable::own_rank(PointId p, int k) const {
  for (const int plane : points_[p].planes)
    if (planes_.class_of(plane) == k) return planes_.rank_of(plane);
  return rank_beside(p, planes_.normal_class(k));
}

/// The rank of a point that is not known to lie on a plane of the class.
int PointTable::rank_beside(PointId p, const PlaneTable::ParallelPlanes& c) const {
  const double along = dot(c.normal, at(p));
  if (along + kCertain_m < c.offsets_m.front()) return 0;
  if (along - kCertain_m > c.offsets_m.back()) return 2 * static_cast<int>(c.offsets_m.size());
  return rank_between(p, c, along);
}

/// The same where the point, `along` the normal, is not outside all planes.
int PointTable::rank_between(PointId p, const PlaneTable::ParallelPlanes& c, double along) const {
  auto i = std::ranges::lower_bound(c.offsets_m, along - kCertain_m) - c.offsets_m.begin();
  for (; i < std::ssize(c.offsets_m) &&
         c.offsets_m[static_cast<std::size_t>(i)] <= along + kCertain_m;
       ++i) {
    const int side = exact_side(exact_at(p), c.planes[static_cast<std::size_t>(i)]);
    if (side == 0) return 2 * static_cast<int>(i) + 1;
    if (side < 0) break;
  }
  return 2 * static_cast<int>(i);
}

int PointTable::compute_rank(PointId p, int k) {
  const TablePoint& point = points_[p];
  const int own = own_rank(p, k);
  if (!point.low.is_valid()) return own;
  const auto& ranks = ranks_[index(k)];
  const auto [least, most] = std::minmax(ranks[point.low], ranks[point.high]);
  return std::clamp(own, least, most);
}

PointRanks PointTable::ranks(int k) {
  auto& ranks = ranks_[index(k)];
  if (ranks.empty()) rank_by_incidence(k);
  while (ranks.size() < points_.size()) ranks.push_back(compute_rank(ranks.next_id(), k));
  return PointRanks(ranks.items());
}

/// Ranks of the solid's vertices: those that lie on planes of the class by these, which most do.
void PointTable::rank_by_incidence(int k) {
  constexpr int kUnknown = -1;
  auto& ranks = ranks_[index(k)];
  work_.add_flat(solid_points_);
  ranks.assign(index(solid_points_), kUnknown);
  const auto& c = planes_.normal_class(k);
  for (const int plane : std::views::reverse(c.planes))
    for (const PointId p : incidence().on(plane)) ranks[p] = planes_.rank_of(plane);
  for (const PointId p : ranks.ids())
    if (ranks[p] == kUnknown) ranks[p] = rank_beside(p, c);
}

const Incidence& PointTable::incidence() {
  if (!incidence_.is_made())
    incidence_.make(solid_points_, planes_.size(),
                    [&](PointId p) -> const boost::container::small_vector<int, 4>& {
                      return points_[p].planes;
                    });
  return incidence_;
}

PointId PointTable::cross_edge(int f, int g, PointId low, PointId high, int plane) {
  ORIEL_ASSERT(side(low, plane) * side(high, plane) < 0, "the edge does not cross the plane");
  TablePoint point;
  point.planes = {f, g, plane};
  std::ranges::sort(point.planes);
  point.low = low;
  point.high = high;
  const Vec3 from = at(low), along = at(high) - from;
  const Plane& cut = planes_.plane(plane);
  const auto where = exact::meet(planes_.plane(f), planes_.plane(g), cut);
  ExactPlace place;
  if (where) place = place_at(*where);
  if (!where || !is_on_segment(place.at, from, along)) {
    // A rounded vertex lies beside the line on which its planes meet. The edge is the segment
    // between its ends, and the point must lie on that, or cutting the edge would change the areas
    // of its facets.
    const double t = (cut.offset_m - dot(cut.normal, from)) / dot(cut.normal, along);
    point.is_rounded = true;
    place = place_at(exact::round_finely(from + std::clamp(t, 0.0, 1.0) * along, grid_m_));
  }
  return add(std::move(point), place);
}

PointId PointTable::add_moved(PointId p, const std::array<std::int64_t, 3>& shift,
                              const NumberMap& planes) {
  const TablePoint& model = points_[p];
  TablePoint point;
  point.is_rounded = model.is_rounded;
  for (const int plane : model.planes)
    if (const auto moved = find_in(planes, plane)) point.planes.push_back(*moved);
  std::ranges::sort(point.planes);
  exact::Rational where = exact_at(p);
  where.x += shift[0] * where.w;
  where.y += shift[1] * where.w;
  where.z += shift[2] * where.w;
  return add(std::move(point), place_at(where));
}

PointId PointTable::add(TablePoint point, const ExactPlace& place) {
  point.stored = static_cast<int>(exact_.size());
  exact_.push_back(place.where);
  places_.push_back(place.at);
  return points_.push_back(std::move(point));
}

std::optional<PointId> PointTable::meet(int p, int q, int r) {
  std::array<int, 3> key{p, q, r};
  std::ranges::sort(key);
  if (const auto known = known_meeting(key)) return known;
  const auto where = exact::meet(planes_.plane(p), planes_.plane(q), planes_.plane(r));
  if (!where) return std::nullopt;
  TablePoint point;
  point.planes.assign(key.begin(), key.end());
  const ExactPlace place = place_at(*where);
  met_.push_back(key);
  PointId& met = meetings_[key];
  if (const auto near = met_near(point, place.at)) return met = *near;
  met = add(std::move(point), place);
  met_in_[cell_of(place.at)].push_back(met);
  return met;
}

void PointTable::forget_since(const PointMark& mark) {
  ORIEL_ASSERT(mark.points <= size() && mark.met <= met_.size() && mark.widened <= widened_.size());
  for (; widened_.size() > mark.widened; widened_.pop_back()) {
    const auto [p, plane] = widened_.back();
    auto& own = points_[p].planes;
    own.erase(std::ranges::find(own, plane));
    const int k = planes_.class_of(plane);
    if (ranks_[index(k)].contains(p)) ranks_[index(k)][p] = compute_rank(p, k);
  }
  for (; met_.size() > mark.met; met_.pop_back()) meetings_.erase(met_.back());
  for (int count = size(); count-- > mark.points;) {
    const PointId p{count};
    const auto cell = met_in_.find(cell_of(at(p)));
    if (cell != met_in_.end() && !cell->second.empty() && cell->second.back() == p)
      cell->second.pop_back();
  }
  if (size() > mark.points) exact_.resize(index(points_[PointId{mark.points}].stored));
  points_.resize(index(mark.points));
  places_.resize(index(mark.points));
  for (auto& ranks : ranks_)
    if (ranks.size() > index(mark.points)) ranks.resize(index(mark.points));
}

PointTable::GridCell PointTable::cell_of(Vec3 p) const {
  const auto cell = [&](double c) { return static_cast<std::int64_t>(std::floor(c / near_m_)); };
  return {cell(p.x), cell(p.y), cell(p.z)};
}

/// A point that was met so near by that it is the same one: more than three planes meet there. It
/// counts as lying on the new planes.
std::optional<PointId> PointTable::met_near(const TablePoint& point, Vec3 where) {
  const GridCell middle = cell_of(where);
  for (int i = 0; i < 27; ++i) {
    const auto found =
        met_in_.find({middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1});
    if (found == met_in_.end()) continue;
    for (const PointId p : found->second)
      if (length(at(p) - where) <= near_m_ && lies_on_too(p, point.planes)) return p;
  }
  return std::nullopt;
}

/// Adds planes to a point; false if it lies on parallel ones.
bool PointTable::lies_on_too(PointId p, const boost::container::small_vector<int, 4>& planes) {
  auto& own = points_[p].planes;
  for (const int plane : planes)
    for (const int other : own)
      if (plane != other && planes_.class_of(plane) == planes_.class_of(other)) return false;
  for (const int plane : planes) {
    if (std::ranges::binary_search(own, plane)) continue;
    own.insert(std::ranges::lower_bound(own, plane), plane);
    widened_.emplace_back(p, plane);
    auto& ranks = ranks_[index(planes_.class_of(plane))];
    if (ranks.contains(p)) ranks[p] = planes_.rank_of(plane);
  }
  return true;
}

/// The solid's own vertices are found by any three of their planes; the first vertex counts.
std::optional<PointId> PointTable::known_meeting(const std::array<int, 3>& planes) {
  if (const auto met = meetings_.find(planes); met != meetings_.end()) return met->second;
  auto fewest = incidence().on(planes[0]);
  for (const int plane : planes)
    if (const auto points = incidence().on(plane); points.size() < fewest.size()) fewest = points;
  const auto own = std::ranges::find_if(
      fewest, [&](PointId p) { return std::ranges::includes(points_[p].planes, planes); });
  return own == fewest.end() ? std::nullopt : std::optional(*own);
}

}  // namespace oriel::detail
