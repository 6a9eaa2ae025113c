#include "kernel/segment/complex/slice.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// A vertex is on a plane by its coordinates only up to this part of the reach, which is rounding:
/// between planes at a small angle a vertex may be near both and belong to one.
constexpr double kOn = 1e-5;

}  // namespace

int Slicer::side(int vertex) const {
  const auto v = static_cast<std::size_t>(vertex);
  if (is_on_[v] != 0) return 0;
  const double height = dot(plane_.normal, pool_.at(vertex)) - plane_.offset_m;
  if (std::abs(height) <= kOn * pool_.reach_m()) return 0;
  return height > 0 ? 1 : -1;
}

bool Slicer::passes(const std::vector<int>& vertices) const {
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

void Slicer::add_sections(CellId cell, const std::vector<Facet>& facets,
                          std::vector<Chord>& chords) {
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

}  // namespace oriel::detail
