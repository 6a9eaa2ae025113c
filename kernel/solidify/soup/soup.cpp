#include "kernel/solidify/soup/soup.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/base/text/counted.h"
#include "kernel/geometry/near_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// One number for a point, ordered as its coordinates: |coordinate| ≤ 2^32, so 34 bits hold each.
exact::Int128 sort_key(const exact::GridPoint& point) {
  const auto bits = [&](std::size_t axis) {
    return static_cast<std::uint64_t>(point[axis] + (std::int64_t{1} << 33));
  };
  return exact::Int128{bits(0)} << 68 | exact::Int128{bits(1)} << 34 | bits(2);
}

/// Fills Soup::points with the rounded vertices, sorted; returns the point of every vertex, united
/// with those within reach.
Numbers weld_points(const Building& building, double reach, Soup& soup) {
  struct Rounded {
    exact::Int128 key;
    int vertex;
  };
  std::vector<exact::GridPoint> grid_points(building.vertices.size());
  std::vector<Rounded> rounded(building.vertices.size());
  for (std::size_t v = 0; v < rounded.size(); ++v) {
    grid_points[v] = exact::round_to_grid(building.vertices[v], soup.grid_m);
    rounded[v] = {sort_key(grid_points[v]), static_cast<int>(v)};
  }
  std::ranges::sort(rounded, {}, &Rounded::key);

  Numbers point_of(building.vertices.size());
  soup.points.reserve(building.vertices.size());
  for (std::size_t i = 0; i < rounded.size(); ++i) {
    if (i == 0 || rounded[i].key != rounded[i - 1].key)
      soup.points.push_back(grid_points[at(rounded[i].vertex)]);
    point_of[at(rounded[i].vertex)] = static_cast<int>(soup.points.size()) - 1;
  }
  const Numbers first = group_near_points(soup.points, reach);
  for (int& point : point_of) point = first[at(point)];
  return point_of;
}

/// Appends the simple rings that rings consist of to a soup, each from its smallest vertex.
class RingCutter {
 public:
  /// `corner_count`: of all rings to come.
  RingCutter(Soup& soup, std::size_t corner_count)
      : soup_(soup), last_ring_(soup.points.size(), 0), place_in_path_(soup.points.size(), -1) {
    // As much as there may be; finish() takes back what is left over.
    soup.corners.resize(corner_count);
    soup.first_corner.resize(corner_count / 3 + 1);
  }

  [[nodiscard]] int ring_count() const { return ring_count_; }
  /// True if all points are known to be on the rings that are left.
  [[nodiscard]] bool uses_all_points() const {
    return !has_dropped_ && std::ranges::find(last_ring_, 0) == last_ring_.end();
  }

  /// Where the ring comes back to a point (it touches itself, or a bridge ties a hole to its outer
  /// ring) it is cut in two, and what has fewer than three vertices goes.
  void append(std::span<const int> ring, std::span<const int> point_of) {
    const int number = ++ring_;
    int* const points = soup_.corners.data() + end_;
    int* const last_ring = last_ring_.data();
    std::size_t smallest = 0;
    bool is_simple = true;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int v = point_of[at(ring[i])];
      is_simple &= last_ring[v] != number;
      last_ring[v] = number;
      points[i] = v;
      if (v < points[smallest]) smallest = i;
    }
    if (is_simple)
      keep(ring.size(), smallest);
    else
      cut({points, points + ring.size()});
  }

  void finish() {
    soup_.corners.resize(end_);
    soup_.first_corner.resize(at(ring_count_) + 1);
  }

 private:
  /// Makes the points that stand after the last ring a ring.
  void keep(std::size_t size, std::size_t smallest) {
    if (size < 3) {
      has_dropped_ = true;
      return;
    }
    int* const begin = soup_.corners.data() + end_;
    if (smallest > 0) std::rotate(begin, begin + smallest, begin + size);
    end_ += size;
    soup_.first_corner[at(++ring_count_)] = static_cast<int>(end_);
  }

  void cut(Numbers ring) {
    for (const int v : ring) {
      if (place_in_path_[at(v)] >= 0) close_at(at(place_in_path_[at(v)]));
      place_in_path_[at(v)] = static_cast<int>(path_.size());
      path_.push_back(v);
    }
    close_at(0);
  }

  /// Makes the end of the path from place `start` a ring and takes it off the path.
  void close_at(std::size_t start) {
    const auto ring = std::span(path_).subspan(start);
    std::ranges::copy(ring, soup_.corners.data() + end_);
    keep(ring.size(), static_cast<std::size_t>(std::ranges::min_element(ring) - ring.begin()));
    for (const int v : ring) place_in_path_[at(v)] = -1;
    path_.resize(start);
  }

  Soup& soup_;
  std::size_t end_ = 0;  ///< of the corners so far
  int ring_count_ = 0;
  int ring_ = 0;
  bool has_dropped_ = false;  ///< a ring of fewer than three vertices
  Numbers last_ring_;         ///< that came to each point
  Numbers path_;
  Numbers place_in_path_;  ///< by point, -1 off the path
};

/// Leaves only the points in use, in their order.
void drop_unused_points(Soup& soup) {
  std::vector<char> is_used(soup.points.size(), 0);
  for (const int v : soup.corners) is_used[at(v)] = 1;
  if (std::ranges::find(is_used, 0) == is_used.end()) return;
  Numbers place(soup.points.size(), -1);
  int used = 0;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (!is_used[v]) continue;
    soup.points[at(used)] = soup.points[v];
    place[v] = used++;
  }
  soup.points.resize(at(used));
  for (int& v : soup.corners) v = place[at(v)];
}

/// Appends the building's polygons in its order, with the points in use. Returns how many have
/// nothing left of their outer ring and were dropped.
int append_polygons(const Building& building, std::span<const int> point_of, Soup& soup) {
  std::size_t corner_count = 0;
  for (const Polygon& polygon : building.polygons)
    for (const auto& ring : polygon.rings) corner_count += ring.size();
  RingCutter cutter(soup, corner_count);
  soup.polygons.resize(building.polygons.size());
  soup.first_ring.resize(building.polygons.size() + 1);
  std::size_t count = 0;
  for (const Polygon& polygon : building.polygons) {
    const int first = cutter.ring_count();
    for (const auto& ring : polygon.rings) {
      cutter.append(ring, point_of);
      if (cutter.ring_count() == first) break;
    }
    const int end = cutter.ring_count();
    if (end == first) continue;
    soup.polygons[count] = {polygon.source, polygon.body, polygon.shell};
    soup.first_ring[++count] = end;
  }
  cutter.finish();
  const int dropped = static_cast<int>(soup.polygons.size() - count);
  soup.polygons.resize(count);
  soup.first_ring.resize(count + 1);
  if (!cutter.uses_all_points()) drop_unused_points(soup);
  return dropped;
}

}  // namespace

double grid_for(double weld_m) { return std::exp2(std::floor(std::log2(weld_m / 1024))); }

Soup weld(const Building& building, const Tolerances& tolerances, std::vector<Issue>& issues) {
  Soup soup;
  soup.grid_m = grid_for(tolerances.weld_m);
  const Numbers point_of = weld_points(building, tolerances.weld_m / soup.grid_m, soup);
  const int dropped = append_polygons(building, point_of, soup);
  if (dropped > 0)
    issues.push_back(
        building_issue(Severity::note, Code::E304, building.id,
                       fmt::format("{} degenerate after welding at {} m and {} dropped",
                                   counted(dropped, "polygon is", "polygons are"),
                                   tolerances.weld_m, agreeing(dropped, "was", "were"))));
  return soup;
}

SoupBuilder::SoupBuilder(const Soup& like) : place_(like.points.size(), -1) {
  soup_.grid_m = like.grid_m;
  soup_.points = like.points;
}

void SoupBuilder::begin_polygon(const SoupPolygon& said) {
  ORIEL_ASSERT(soup_.polygons.empty() || soup_.polygons.back().body <= said.body,
               "polygons come by body");
  close_polygon();
  soup_.polygons.push_back(said);
  is_begun_ = true;
}

void SoupBuilder::add_ring(std::span<const int> ring) {
  ORIEL_ASSERT(is_begun_, "a ring is of a polygon");
  for (const int v : ring) {
    const int place = place_[at(v)];
    if (place >= 0) {
      const auto loop = std::span<const int>(path_).subspan(at(place));
      if (loop.size() >= 3) append(loop);
      for (const int w : loop) place_[at(w)] = -1;
      path_.resize(at(place));
    }
    place_[at(v)] = static_cast<int>(path_.size());
    path_.push_back(v);
  }
  if (path_.size() >= 3) append(path_);
  for (const int v : path_) place_[at(v)] = -1;
  path_.clear();
}

void SoupBuilder::add_polygon(const Soup& from, int polygon, bool is_turned) {
  begin_polygon(from.polygons[at(polygon)]);
  for (const int r : from.rings_of(polygon)) {
    append(from.ring(r));
    if (is_turned)
      std::reverse(soup_.corners.begin() + soup_.first_corner[at(soup_.ring_count() - 1)] + 1,
                   soup_.corners.end());
  }
}

Soup SoupBuilder::finish() {
  close_polygon();
  return std::move(soup_);
}

void SoupBuilder::close_polygon() {
  if (!is_begun_) return;
  is_begun_ = false;
  if (soup_.ring_count() == soup_.first_ring.back())
    soup_.polygons.pop_back();
  else
    soup_.first_ring.push_back(soup_.ring_count());
}

void SoupBuilder::append(std::span<const int> simple_ring) {
  ORIEL_ASSERT(simple_ring.size() >= 3);
  const auto begin =
      soup_.corners.insert(soup_.corners.end(), simple_ring.begin(), simple_ring.end());
  std::rotate(begin, std::min_element(begin, soup_.corners.end()), soup_.corners.end());
  soup_.first_corner.push_back(static_cast<int>(soup_.corners.size()));
}

Soup with_faces(const Soup& soup, std::vector<AddedFace> faces) {
  const auto body = [&](int polygon) { return soup.polygons[at(polygon)].body; };
  std::ranges::stable_sort(faces, {}, [&](const AddedFace& face) { return body(face.beside); });
  SoupBuilder builder(soup);
  std::size_t next = 0;
  for (int p = 0; p < soup.polygon_count(); ++p) {
    builder.add_polygon(soup, p);
    if (p + 1 < soup.polygon_count() && body(p + 1) == body(p)) continue;
    for (; next < faces.size() && body(faces[next].beside) == body(p); ++next) {
      SoupPolygon said = soup.polygons[at(faces[next].beside)];
      said.source = kNoSource;
      builder.begin_polygon(said);
      for (const auto& ring : faces[next].rings) builder.add_ring(ring);
    }
  }
  return builder.finish();
}

}  // namespace oriel
