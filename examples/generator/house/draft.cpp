#include "examples/generator/house/draft.h"

#include "examples/generator/geometry/rings.h"
#include "kernel/base/index.h"

#include <utility>

namespace oriel::generator {
namespace {

/// Marks the points that only two facets pass, straight on: nothing needs them.
std::vector<bool> find_idle_points(const std::vector<Point>& points,
                                   const std::vector<std::vector<Loop>>& facets) {
  std::vector<int> degree(points.size(), 0);
  std::vector<bool> is_straight(points.size(), true);
  for (const std::vector<Loop>& loops : facets)
    for (const Loop& loop : loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int here = loop[i];
        const Point before = points[at(loop[(i + loop.size() - 1) % loop.size()])];
        const Point after = points[at(loop[(i + 1) % loop.size()])];
        ++degree[at(here)];
        if (cross(points[at(here)] - before, after - points[at(here)]) != Point{})
          is_straight[at(here)] = false;
      }
  std::vector<bool> is_idle(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) is_idle[i] = degree[i] == 2 && is_straight[i];
  return is_idle;
}

/// The loop without its idle points, as indices of the body's vertices; a vertex is added to the
/// body where it is first met.
Loop renumbered(const std::vector<Point>& points, const std::vector<bool>& is_idle,
                const Loop& loop, std::vector<int>& vertex_of, Body& body) {
  Loop result;
  for (const int point : loop) {
    if (is_idle[at(point)]) continue;
    int& vertex = vertex_of[at(point)];
    if (vertex < 0) {
      vertex = static_cast<int>(body.vertices.size());
      body.vertices.push_back(points[at(point)]);
    }
    result.push_back(vertex);
  }
  return result;
}

}  // namespace

int Draft::add_object(Object object) {
  const std::string stem(object.kind == Class::other || object.kind == Class::ground
                             ? std::string_view(object.subclass)
                             : object.label());
  object.name = stem + "_" + std::to_string(++ordinals_[stem]);
  objects_.push_back(std::move(object));
  return static_cast<int>(objects_.size()) - 1;
}

FacetId Draft::add_facet(Owner owner) {
  facets_.push_back({owner, {}});
  return FacetId{static_cast<int>(facets_.size()) - 1};
}

FacetId Draft::add_ring(FacetId facet, Owner owner, const Ring& ring) {
  if (facet == kNewFacet) facet = add_facet(owner);
  add_ring(facet, ring);
  return facet;
}

void Draft::add_ring(FacetId facet, const Ring& ring) {
  Loop loop;
  for (const Point& point : ring) {
    const int vertex = vertex_at(point);
    if (loop.empty() || (vertex != loop.back() && vertex != loop.front())) loop.push_back(vertex);
  }
  facets_[static_cast<std::size_t>(facet)].rings.push_back(std::move(loop));
}

int Draft::vertex_at(Point point) {
  const auto [it, is_new] = number_of_.emplace(point, static_cast<int>(points_.size()));
  if (is_new) points_.push_back(point);
  return it->second;
}

Body Draft::close() const {
  const PointsOnEdges points_on_edges(points_);
  std::vector<std::vector<Loop>> loops(facets_.size());
  std::vector<Vec3> normals(facets_.size());
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    for (const Loop& ring : facets_[i].rings) {
      loops[i].push_back(split(ring, points_on_edges));
      normals[i] = normals[i] + doubled_area(points_, ring);
    }
    if (loops[i].size() > 1) loops[i] = trace(points_, normals[i], boundary(loops[i]));
  }
  const std::vector<bool> is_idle = find_idle_points(points_, loops);
  std::vector<int> vertex_of(points_.size(), -1);
  Body body;
  body.objects = objects_;
  for (std::size_t i = 0; i < facets_.size(); ++i)
    for (const std::vector<Loop>& rings : nest(points_, normals[i], std::move(loops[i]))) {
      Polygon polygon{facets_[i].owner, {}};
      for (const Loop& ring : rings)
        polygon.rings.push_back(renumbered(points_, is_idle, ring, vertex_of, body));
      body.polygons.push_back(std::move(polygon));
    }
  return body;
}

}  // namespace oriel::generator
