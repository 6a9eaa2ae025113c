#include "kernel/segment/detail/parts.h"

#include "kernel/geometry/planar.h"

#include <algorithm>
#include <map>

namespace oriel::detail {

namespace {

void sort_uniquely(std::vector<int>& points) {
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

}  // namespace

std::vector<std::size_t> models_of(const Choice& choice) {
  std::map<int, std::size_t> last_of_kind;
  const auto& lumps = choice.lumps;
  for (std::size_t i = 0; i < lumps.size(); ++i) {
    if (lumps[i].is_alone) continue;
    if (lumps[i].pocket < 0) return {};
    const int kind = choice.pockets->kind_of(lumps[i].pocket);
    if (!choice.pockets->is_convex(kind)) return {};
    last_of_kind[kind] = i;
  }
  std::vector<std::size_t> models;
  for (std::size_t i = 0; i < lumps.size(); ++i)
    models.push_back(lumps[i].is_alone ? i
                                       : last_of_kind.at(choice.pockets->kind_of(lumps[i].pocket)));
  return models;
}

Change change_of(const Carved& carved, const std::vector<Cap>& caps) {
  Change change{carved.touched, {}, {}, false, carved.is_ring, {}, false};
  const Boundary& part = carved.lump;
  for (int e = 0; e < part.half_edge_count(); ++e)
    if (part.is_alive_edge(e)) change.part.push_back(part.origin(e));
  sort_uniquely(change.points);
  sort_uniquely(change.part);
  if (change.part == change.points) change.part.clear();
  const bool is_simple =
      caps.size() == 1 && caps[0].loops.size() == 1 && caps[0].covered.empty() && !caps[0].is_taken;
  if (is_simple)
    for (const CapEdge& edge : caps[0].loops[0].edges) change.rim.emplace_back(edge.from, edge.to);
  for (const Cap& cap : caps) change.has_covered |= !cap.covered.empty() || cap.is_taken;
  if (carved.has_rim_left)
    for (const Cap& cap : caps)
      for (const CapLoop& loop : cap.loops)
        for (const CapEdge& edge : loop.edges) change.new_edges.emplace_back(edge.from, edge.to);
  return change;
}

double area_of(const World& world, const Cap& cap) {
  double area = 0;
  for (const CapLoop& loop : cap.loops) {
    Outline outline;
    for (const CapEdge& edge : loop.edges) outline.push_back(world.points.at(edge.from));
    area += signed_area(outline, world.planes.normal(cap.side));
  }
  return area;
}

void measure(Feature& feature, const Boundary& body) {
  feature.volume_m3 = body.volume();
  for (const int f : body.living_facets()) {
    feature.surface_m2 += body.area(f);
    body.for_each_edge(f, [&](int e) { feature.vertices.push_back(body.origin(e)); });
  }
  sort_uniquely(feature.vertices);
}

}  // namespace oriel::detail
