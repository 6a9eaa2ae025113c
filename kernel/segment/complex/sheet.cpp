#include "kernel/segment/complex/sheet.h"

#include "kernel/base/assert.h"
#include "kernel/segment/complex/arrangement.h"
#include "kernel/segment/complex/refine.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace oriel::detail {

namespace {

/// A vertex is on a plane by its coordinates only up to this part of the reach, which is rounding:
/// between planes at a small angle a vertex may be near both and belong to one.
constexpr double kOn = 1e-5;  // tolerance of doubles

}  // namespace

int Slicer::side(int vertex) const {
  const auto v = static_cast<std::size_t>(vertex);
  ORIEL_ASSERT(v < is_on_.size());
  if (is_on_[v] != 0) return 0;
  const double height = dot(plane_.normal, pool_.at(vertex)) - plane_.offset_m;
  if (std::abs(height) <= kOn * pool_.reach_m()) return 0;
  return height > 0 ? 1 : -1;
}

bool Slicer::passes(std::span<const int> vertices) const {
  bool is_behind = false, is_in_front = false;
  for (const int v : vertices) {
    const int where = side(v);
    is_behind |= where < 0;
    is_in_front |= where > 0;
    if (is_behind && is_in_front) return true;
  }
  return false;
}

void Slicer::add_facet(CellId cell, const Facet& facet, std::vector<Chord>& chords) const {
  // Facets look out of their cell.
  const Vec3 normal = planes_[facet.plane.index()].normal;
  const bool looks_forward = dot(normal, plane_.normal) > 0;
  const int label = label_of(cell.value, !looks_forward);
  for (const Loop& loop : facet.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      int from = loop[i], to = loop[(i + 1) % loop.size()];
      if (!looks_forward) std::swap(from, to);
      chords.push_back({from, to, label, 1});
    }
}

void Slicer::add_sections(CellId cell, std::span<const Facet> facets, std::vector<Chord>& chords) {
  for (const Facet& facet : facets)
    for (const bool is_in_front : {false, true})
      add_section(facet, label_of(cell.value, is_in_front), chords);
}

void Slicer::add_section(const Facet& facet, int label, std::vector<Chord>& chords) {
  const Vec3 normal = planes_[facet.plane.index()].normal;
  const Vec3 along = cross(plane_.normal, normal);
  const auto is_above = [&](int v) { return is_in_front(label) ? side(v) > 0 : side(v) >= 0; };
  // Along the section the facet is entered over an edge that goes down and left over one that goes
  // up. Matched by their order, each as often as the other, whatever rounding does.
  struct FacetCrossing {
    double position;
    int vertex;
  };
  std::vector<FacetCrossing> down, up;
  for (const Loop& loop : facet.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      if (is_above(a) == is_above(b)) continue;
      const int vertex = cross_edge(a, b);
      (is_above(a) ? down : up).push_back({dot(along, pool_.at(vertex)), vertex});
    }
  std::ranges::stable_sort(down, {}, &FacetCrossing::position);
  std::ranges::stable_sort(up, {}, &FacetCrossing::position);
  for (std::size_t i = 0; i < down.size(); ++i)
    if (down[i].vertex != up[i].vertex) chords.push_back({down[i].vertex, up[i].vertex, label, 1});
}

int Slicer::cross_edge(int a, int b) {
  if (side(a) == 0) return a;
  if (side(b) == 0) return b;
  const auto [entry, is_new] = crossings_.try_emplace(std::minmax(a, b), -1);
  if (is_new) {
    const auto [low, high] = entry->first;
    const Vec3 from = pool_.at(low), to = pool_.at(high);
    const double before = dot(plane_.normal, from) - plane_.offset_m;
    const double after = dot(plane_.normal, to) - plane_.offset_m;
    entry->second = pool_.find_or_add(from + (before / (before - after)) * (to - from));
  }
  return entry->second;
}

namespace {

/// The cells on either side. Both invalid where they are the same: there is no face.
struct FaceCells {
  CellId front, behind;
  friend bool operator==(FaceCells, FaceCells) = default;
};

/// Joins the regions of an arrangement that have the same sides, and traces what is left.
class Sheet {
 public:
  Sheet(const Arrangement& arrangement, Owners& owners)
      : arrangement_(arrangement), group_(arrangement.region_count()) {
    for (const std::vector<int>& labels : arrangement.labels()) {
      std::vector<int> front, behind;
      for (const int label : labels)
        (is_in_front(label) ? front : behind).push_back(cell_of(label));
      const FaceCells sides{owners.of(front), owners.of(behind)};
      sides_.push_back(sides.front == sides.behind ? FaceCells{} : sides);
    }
    std::iota(group_.begin(), group_.end(), std::size_t{0});
    for (std::size_t h = 0; h < arrangement.half_edge_count(); h += 2)
      if (!is_border(h)) group_[group_of(region(h))] = group_of(region(Arrangement::twin(h)));
  }

  /// The loops of the faces, in no order.
  [[nodiscard]] std::vector<Face> faces(PlaneId plane) {
    std::map<std::size_t, Face> faces;
    std::vector<char> is_traced(arrangement_.half_edge_count(), 0);
    for (std::size_t start = 0; start < is_traced.size(); ++start) {
      const FaceCells& sides = sides_[region(start)];
      if (is_traced[start] != 0 || !is_border(start) || sides == FaceCells{}) continue;
      Loop loop;
      for (std::size_t h = start; is_traced[h] == 0; h = next_border(h)) {
        is_traced[h] = 1;
        loop.push_back(arrangement_.origin(h));
      }
      Face& face = faces[group_of(region(start))];
      face.plane = plane;
      face.front = sides.front;
      face.behind = sides.behind;
      face.loops.push_back(std::move(loop));
    }
    std::vector<Face> list;
    for (auto& [group, face] : faces) list.push_back(std::move(face));
    return list;
  }

 private:
  [[nodiscard]] std::size_t region(std::size_t h) const { return arrangement_.region(h); }
  [[nodiscard]] bool is_border(std::size_t h) const {
    return sides_[region(h)] != sides_[region(Arrangement::twin(h))];
  }
  [[nodiscard]] std::size_t next_border(std::size_t h) const {
    h = arrangement_.next(h);
    while (!is_border(h)) h = arrangement_.next(Arrangement::twin(h));
    return h;
  }
  std::size_t group_of(std::size_t region) {
    while (group_[region] != region) region = group_[region] = group_[group_[region]];
    return region;
  }

  const Arrangement& arrangement_;
  std::vector<FaceCells> sides_;
  std::vector<std::size_t> group_;
};

/// The outer loop first, each loop from its smallest vertex on.
void put_in_order(Face& face, const PlaneAxes& axes, const VertexPool& pool) {
  const auto area = [&](const Loop& loop) {
    const Vec2 base = axes(pool.at(loop[0]));
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum +=
          cross(axes(pool.at(loop[i])) - base, axes(pool.at(loop[(i + 1) % loop.size()])) - base);
    return sum;
  };
  for (Loop& loop : face.loops) std::ranges::rotate(loop, std::ranges::min_element(loop));
  std::ranges::sort(face.loops);
  const auto outer = std::ranges::max_element(face.loops, {}, area);
  std::rotate(face.loops.begin(), outer, outer + 1);
}

}  // namespace

std::vector<Face> faces_of_sheet(PlaneId plane, Vec3 normal, std::vector<Chord> chords,
                                 Owners& owners, VertexPool& pool, Work& work) {
  const PlaneAxes axes(normal);
  const std::vector<PlanarEdge> edges = refine(std::move(chords), axes, pool, work);
  const Arrangement arrangement(edges, axes, pool);
  std::vector<Face> faces = Sheet(arrangement, owners).faces(plane);
  for (Face& face : faces) put_in_order(face, axes, pool);
  std::ranges::sort(faces, {}, [](const Face& face) {
    return std::pair{std::pair{face.behind, face.front}, face.loops};
  });
  return faces;
}

}  // namespace oriel::detail
