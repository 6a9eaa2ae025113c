#pragma once

#include "kernel/base/assert.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/base/work.h"
#include "kernel/geometry/exact.h"
#include "kernel/segment/planes/planes.h"
#include "model/solid.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>

namespace oriel::detail {

/// A number for each of some numbers, sorted.
using NumberMap = std::vector<std::pair<int, int>>;

/// What `key` is mapped to in a sorted list of pairs; nothing if there is nothing.
template <class Key, class Value>
std::optional<Value> find_in(const std::vector<std::pair<Key, Value>>& map, Key key) {
  const auto found = std::ranges::lower_bound(map, key, {}, &std::pair<Key, Value>::first);
  if (found == map.end() || found->first != key) return std::nullopt;
  return found->second;
}

/// For each plane the points that are known to lie on it, ascending.
class Incidence {
 public:
  /// Makes the lists of all points from 0 on; `planes_of(point)` lists the planes of one.
  template <class PlanesOf>
  void make(int points, int planes, const PlanesOf& planes_of) {
    first_.assign(static_cast<std::size_t>(planes) + 2, 0);
    const auto all = ids_below<PointId>(static_cast<std::size_t>(points));
    for (const PointId p : all)
      for (const int plane : planes_of(p)) ++first_[static_cast<std::size_t>(plane) + 2];
    for (std::size_t i = 2; i < first_.size(); ++i) first_[i] += first_[i - 1];
    points_.resize(first_.back());
    for (const PointId p : all)
      for (const int plane : planes_of(p))
        points_[first_[static_cast<std::size_t>(plane) + 1]++] = p;
  }

  [[nodiscard]] bool is_made() const { return !first_.empty(); }
  [[nodiscard]] std::span<const PointId> on(int plane) const {
    const std::size_t i = static_cast<std::size_t>(plane);
    return std::span(points_).subspan(first_[i], first_[i + 1] - first_[i]);
  }

 private:
  std::vector<std::size_t> first_;  ///< by plane, in points_
  std::vector<PointId> points_;
};

/// The ranks of all points in one class of planes.
class PointRanks {
 public:
  PointRanks() = default;
  explicit PointRanks(std::span<const int> ranks) : ranks_(ranks) {}

  [[nodiscard]] int operator[](PointId point) const {
    ORIEL_ASSERT(point.index() < ranks_.size(), "the point is newer than the ranks");
    return ranks_[point.index()];
  }
  [[nodiscard]] std::size_t size() const { return ranks_.size(); }

 private:
  std::span<const int> ranks_;
};

/// The vertices of a solid and those that cuts make, with their ranks in every class of planes.
///
/// A rank is decided once: by incidence (a point knows the planes it lies on), else by doubles
/// where they are certain, else exactly. Everything the kernel asks of positions is a comparison of
/// ranks; coordinates serve for measuring.
class PointTable {
 public:
  /// The solid's vertices keep their indices: PointId{v} is its v-th. Ranks that are decided
  /// are added to `work`, which so bounds the memory for them.
  PointTable(const Solid& solid, const PlaneTable& planes, Work& work);

  /// Metres per unit of the solid's grid: what is nearer touches.
  [[nodiscard]] double grid_m() const { return grid_m_; }
  [[nodiscard]] int size() const { return static_cast<int>(points_.size()); }
  [[nodiscard]] Vec3 at(PointId point) const { return places_[point]; }
  /// All points, ascending.
  [[nodiscard]] auto ids() const { return points_.ids(); }
  /// True if the point is known by the three planes it was made of.
  [[nodiscard]] bool is_meeting(PointId point) const { return !points_[point].is_rounded; }

  /// The ranks of all points in class k; valid until the next point is added.
  [[nodiscard]] PointRanks ranks(int k);
  [[nodiscard]] int rank(PointId point, int k) {
    const auto& ranks_of_class = ranks_[index(k)];
    return ranks_of_class.contains(point) ? ranks_of_class[point] : ranks(k)[point];
  }
  /// -1, 0, +1: behind, on, in front of a plane as its class has it.
  [[nodiscard]] int side(PointId point, int plane) {
    const int difference = rank(point, planes_.class_of(plane)) - planes_.rank_of(plane);
    return (difference > 0) - (difference < 0);
  }
  /// The same for an oriented plane: +1 where its normal points.
  [[nodiscard]] int level(PointId point, PlaneSide of) {
    const int level = side(point, of >> 1);
    return (of & 1) != 0 ? -level : level;
  }

  /// The point where an edge (the meeting of planes f and g, from `low` to `high`) crosses `plane`.
  /// Its ranks lie between those of the edge's ends, whatever was rounded.
  PointId cross_edge(int f, int g, PointId low, PointId high, int plane);

  /// The point where three planes meet; nothing if they do not. Where more than three meet, up to
  /// weld_m, it is one point and lies on all of them.
  std::optional<PointId> meet(int p, int q, int r);

  /// TablePoint `p` moved by a whole number of grid units, on the planes that those of p are mapped
  /// to.
  PointId add_moved(PointId p, const std::array<std::int64_t, 3>& shift, const NumberMap& planes);

  /// What is there now, to come back to if what is tried next is not kept.
  struct PointMark {
    int points;
    std::size_t met, widened;
  };
  [[nodiscard]] PointMark mark() const { return {size(), met_.size(), widened_.size()}; }
  /// Forgets the points that were made since, which nothing may use any more, and the planes that
  /// older ones were found to lie on since. Marks are gone back to last made first.
  void forget_since(const PointMark& mark);

 private:
  struct TablePoint {
    boost::container::small_vector<int, 4> planes;  ///< sorted
    bool is_rounded = false;
    PointId low, high;  ///< the ends of the edge it was made on
    int stored = -1;    ///< in exact_; -1: it is where its first three planes meet
  };
  /// Where a point is, exactly and in metres.
  struct ExactPlace {
    exact::Rational where;
    Vec3 at;
  };
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  using GridCell = std::array<std::int64_t, 3>;
  [[nodiscard]] std::optional<PointId> known_meeting(const std::array<int, 3>& planes);
  const Incidence& incidence();
  [[nodiscard]] std::optional<Vec3> meeting_of(const TablePoint& point) const;
  void list_planes(std::span<const Facet> facets);
  void rank_by_incidence(int k);
  [[nodiscard]] GridCell cell_of(Vec3 p) const;
  std::optional<PointId> met_near(const TablePoint& point, Vec3 where);
  bool lies_on_too(PointId p, const boost::container::small_vector<int, 4>& planes);
  PointId add(TablePoint point, const ExactPlace& place);
  [[nodiscard]] Vec3 metres_of(const exact::Rational& where) const;
  [[nodiscard]] ExactPlace place_at(const exact::Rational& where) const {
    return {where, metres_of(where)};
  }
  [[nodiscard]] exact::Rational exact_at(PointId p) const;
  [[nodiscard]] int exact_side(const exact::Rational& point, int plane) const;
  int compute_rank(PointId point, int k);
  [[nodiscard]] int own_rank(PointId p, int k) const;
  [[nodiscard]] int rank_beside(PointId p, const PlaneTable::ParallelPlanes& c) const;
  [[nodiscard]] int rank_between(PointId p, const PlaneTable::ParallelPlanes& c,
                                 double along) const;

  double grid_m_;
  double near_m_;  ///< points that were met closer than this are one
  const PlaneTable& planes_;
  Work& work_;
  IndexedVector<PointId, TablePoint> points_;
  IndexedVector<PointId, Vec3> places_;  ///< close together
  std::vector<exact::Rational> exact_;
  std::vector<IndexedVector<PointId, int>> ranks_;  ///< by class
  Incidence incidence_;  ///< of the solid's vertices; made when it is asked for
  int solid_points_ = 0;
  std::map<std::array<int, 3>, PointId>
      meetings_;                         ///< points that meet() has made, by three planes
  std::vector<std::array<int, 3>> met_;  ///< their keys, in order
  std::vector<std::pair<PointId, int>>
      widened_;  ///< points and planes that lies_on_too() gave them
  std::map<GridCell, std::vector<PointId>> met_in_;  ///< points made by meet(), by cells of near_m_
};

}  // namespace oriel::detail
