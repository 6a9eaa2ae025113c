#include "kernel/segment/cuts/parts.h"

#include "kernel/base/index.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <map>
#include <ranges>
#include <utility>

namespace oriel::detail {

namespace {

/// The points, sorted, each once: about `most` of them.
template <class Points>
std::vector<int> sorted_uniquely(Points&& points, int most, World& world) {
  std::vector<int> sorted;
  sorted.reserve(at(most));
  world.scratch.met_points.start(world.points.size());
  for (const int p : points)
    if (world.scratch.met_points.insert(p)) sorted.push_back(p);
  std::ranges::sort(sorted);
  return sorted;
}

std::vector<std::pair<int, int>> edges_of(const CapLoop& loop) {
  std::vector<std::pair<int, int>> edges;
  edges.reserve(loop.edges.size());
  for (const CapEdge& edge : loop.edges) edges.emplace_back(edge.from, edge.to);
  return edges;
}

}  // namespace

std::vector<std::size_t> models_of(const Choice& choice) {
  std::map<int, std::size_t> last_of_kind;
  const auto& lumps = choice.lumps;
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    if (lumps[i].is_alone) continue;
    if (lumps[i].pocket < 0) return {};
    const int kind = choice.pockets->kind_of(lumps[i].pocket);
    last_of_kind[kind] = i;
  }
  std::vector<std::size_t> models;
  models.reserve(lumps.size());
  for (std::size_t i = 0; i < lumps.size(); ++i)
    models.push_back(lumps[i].is_alone ? i
                                       : last_of_kind.at(choice.pockets->kind_of(lumps[i].pocket)));
  return models;
}

bool is_leaf(const Choice& choice, const Lump& lump, const std::vector<std::size_t>& models) {
  return !models.empty() && choice.is_natural && lump.pocket >= 0 &&
         choice.pockets->is_leaf(choice.pockets->kind_of(lump.pocket));
}

std::vector<int> points_of(const Boundary& body) {
  const auto edges = std::views::iota(0, body.half_edge_count());
  const auto is_alive = [&](int e) { return body.is_alive_edge(e); };
  const auto origin = [&](int e) { return body.origin(e); };
  constexpr int kEdgesAtPoint = 3;  // at least
  return sorted_uniquely(edges | std::views::filter(is_alive) | std::views::transform(origin),
                         body.half_edge_count() / kEdgesAtPoint, body.world());
}

RestChange change_of(const Carved& carved, const std::vector<Cap>& caps, std::size_t size) {
  RestChange change;
  change.points = sorted_uniquely(carved.touched, static_cast<int>(size), carved.lump.world());
  const bool is_simple =
      caps.size() == 1 && caps[0].loops.size() == 1 && caps[0].covered.empty() && !caps[0].is_taken;
  if (is_simple) change.rim = edges_of(caps[0].loops[0]);
  for (const Cap& cap : caps) {
    change.has_covered |= !cap.covered.empty() || cap.is_taken;
    if (!carved.has_rim_left) continue;
    for (const CapLoop& loop : cap.loops)
      for (const CapEdge& edge : loop.edges) change.new_edges.emplace_back(edge.from, edge.to);
  }
  return change;
}

RestChange change_of_pocket(const Cap& cap, std::vector<int> points) {
  return {.points = std::move(points), .rim = edges_of(cap.loops[0]), .is_natural = true};
}

double area_of(World& world, const Cap& cap) {
  double area = 0;
  for (const CapLoop& loop : cap.loops) {
    Outline& outline = world.scratch.outline;
    outline.clear();
    for (const CapEdge& edge : loop.edges) outline.push_back(world.points.at(edge.from));
    area += signed_area(outline, world.planes.normal(cap.side));
  }
  return area;
}

void measure(Feature& feature, const Boundary& body) {
  feature.volume_m3 = body.volume();
  for (int f = 0; f < body.facet_count(); ++f)
    if (body.is_alive(f)) feature.surface_m2 += body.area(f);
}

}  // namespace oriel::detail
