#include "kernel/segment/tree/cells.h"

#include "kernel/base/index.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// Figures in one plane with these boxes may overlap. What is across the plane does not count:
/// polygons are as they came, facets are snapped.
bool may_overlap(const Box& p, const Box& q, Vec3 normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  const double most = std::max({x, y, z});
  return (x == most || (p.min.x < q.max.x && q.min.x < p.max.x)) &&
         (y == most || (p.min.y < q.max.y && q.min.y < p.max.y)) &&
         (z == most || (p.min.z < q.max.z && q.min.z < p.max.z));
}

std::vector<const Polygon*> polygon_of_each_source(const Building& building) {
  std::vector<const Polygon*> polygons(building.polygons.size());
  for (const Polygon& polygon : building.polygons) {
    if (std::ssize(polygons) <= polygon.source) polygons.resize(at(polygon.source) + 1);
    polygons[at(polygon.source)] = &polygon;
  }
  return polygons;
}

/// True if no point from p to q may lie over a box. Each coordinate of points on a line only grows,
/// or only falls.
bool misses(Vec3 p, Vec3 q, const Box& box, Vec3 normal) {
  Box line;
  line.grow(p);
  line.grow(q);
  return !may_overlap(line, box, normal);
}

/// Points spread over a polygon, a grid of about 8 × 8 in its box: where most of them lie is where
/// most of it lies.
std::vector<Vec3> samples_of(std::span<const Outline> polygon, Vec3 normal) {
  Box box;
  for (const Vec3 p : polygon[0]) box.grow(p);
  const auto middle = interior_point(polygon, normal);
  if (!middle) return {};
  std::vector<Vec3> samples{*middle};
  const auto [u, v] = axes_in(normal);
  const double reach = length(box.max - box.min);
  constexpr int kSteps = 8;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const Vec3 in_row = *middle + (reach * i / kSteps) * u;
    const auto point = [&](int j) { return in_row + (reach * j / kSteps) * v; };
    if (misses(point(-kSteps), point(kSteps), box, normal)) continue;
    for (int j = -kSteps; j <= kSteps; ++j) {
      const Vec3 p = point(j);
      if (may_overlap(Box{p, p}, box, normal) && contains(polygon, normal, p)) samples.push_back(p);
    }
  }
  return samples;
}

}  // namespace

PlaneId CellWriter::plane_id(PlaneSide side) {
  if (const PlaneId id = world_.planes.id_of(side); id.is_valid()) return id;
  if (extra_planes_.empty()) extra_planes_.resize(2 * at(world_.planes.size()));
  PlaneId& id = extra_planes_[at(side)];
  if (!id.is_valid()) {
    id = PlaneId{static_cast<int>(out_.planes.size())};
    const Plane& plane = world_.planes.plane(side >> 1);
    out_.planes.push_back((side & 1) != 0 ? exact::opposite(plane) : plane);
    extra_sides_.push_back(side);
  }
  return id;
}

PlaneSide CellWriter::side_of(PlaneId id) const {
  const std::size_t own = out_.planes.size() - extra_sides_.size();
  return id.index() < own ? world_.planes.side_of(id) : extra_sides_[id.index() - own];
}

void CellWriter::copy_sources(std::span<const std::pair<FacetId, FacetId>> sources, CellId first,
                              CellId last, int copies) {
  for (const auto& [source, copy] : sources)
    for (std::size_t i = 0; i < made_of_[source].size(); ++i) {
      const CellFacet here = made_of_[source][i];
      if (here.cell.value >= first.value && here.cell.value < last.value)
        made_of_[copy].push_back({CellId{here.cell.value - first.value + copies}, here.facet});
    }
}

CellId CellWriter::add(const Boundary& body, NodeId node, int sign, bool is_convex, LeafFlag flag,
                       FeatureId feature) {
  const CellId id{static_cast<int>(out_.cells.size())};
  Cell cell{sign, body.volume(), is_convex, flag, node, feature, {}};
  const CornerLoops all_corners(body);
  const std::vector<BodyFacetId> facets = body.living_facets();
  cell.facets.reserve(facets.size());
  for (const BodyFacetId f : facets) {
    const auto& record = body.facet(f);
    const CellFacet here{id, static_cast<int>(cell.facets.size())};
    Facet& facet = cell.facets.emplace_back();
    facet.plane = plane_id(record.side);
    facet.loops = all_corners.loops(f);
    for (const FacetId source : record.sources) made_of_[source].push_back(here);
    for (const CapMark& mark : record.marks) {
      Feature& marked = out_.features[mark.feature.index()];
      marked.host = feature;
      marked.host_facet = here;
    }
  }
  out_.cells.push_back(std::move(cell));
  return id;
}

CellId CellWriter::add(PocketLeaf leaf, NodeId node, int sign, FeatureId feature) {
  const CellId id{static_cast<int>(out_.cells.size())};
  Cell& cell = out_.cells.emplace_back();
  cell.sign = sign;
  cell.volume_m3 = leaf.volume;
  cell.node = node;
  cell.feature = feature;
  cell.facets.reserve(leaf.faces.size());
  for (PocketLeaf::LeafFace& face : leaf.faces) {
    Facet& facet = cell.facets.emplace_back();
    facet.plane = plane_id(face.side);
    facet.loops.push_back(std::move(face.loop));
  }
  for (const auto& [source, face] : leaf.sources) made_of_[source].push_back({id, face});
  return id;
}

void CellWriter::finish(const Building& building, const Solid& solid) {
  out_.vertices.reserve(at(world_.points.size()));
  for (const PointId p : world_.points.ids())
    out_.vertices.push_back({world_.points.at(p), world_.points.is_meeting(p)});
  attribute_polygons(building, solid);
  take_in_hosted();
}

/// How far a feature reaches from the plane that it was cut at.
double CellWriter::reach_m(const Feature& feature) const {
  const Plane& plane = out_.planes[feature.planes.front().index()];
  double reach = 0;
  for (const int v : feature.vertices)
    reach =
        std::max(reach, std::abs(dot(plane.normal, out_.vertices[at(v)].point) - plane.offset_m));
  return reach;
}

/// A protrusion is as large as with the protrusions that stand on it, as if they had been cut off
/// it and not before it: a chimney with its cap, a canopy with its posts. What stands before
/// something flat is no part of it, nor what stands on a roof: stairs before a plinth, a dormer on
/// a slab.
void CellWriter::take_in_hosted() {
  const std::vector<Feature>& features = out_.features;
  const auto is_protrusion = [&](FeatureId id) {
    return features[id.index()].sense == Sense::protrusion;
  };
  std::vector<char> carries(features.size());
  for (int f = 0; f < std::ssize(features); ++f)
    carries[at(f)] = is_protrusion(FeatureId{f}) && reach_m(features[at(f)]) > kFacadeDepth_m &&
                     std::ranges::find(rests_, FeatureId{f}) == rests_.end();
  std::vector<std::pair<FeatureId, FeatureId>> pairs;  // what stands on what
  for (int f = 0; f < std::ssize(features); ++f) {
    if (!is_protrusion(FeatureId{f})) continue;
    FeatureId host = features[at(f)].host;
    for (; host.is_valid() && is_protrusion(host); host = features[host.index()].host)
      if (host != features[at(f)].parent && carries[host.index()])
        pairs.emplace_back(FeatureId{f}, host);
  }
  std::vector<std::vector<int>> own;  // before any has grown
  for (const auto& [inner, outer] : pairs) own.push_back(features[inner.index()].vertices);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    Feature& larger = out_.features[pairs[i].second.index()];
    for (const int v : own[i]) larger.box.grow(out_.vertices[at(v)].point);
    larger.vertices.insert(larger.vertices.end(), own[i].begin(), own[i].end());
    std::ranges::sort(larger.vertices);
    larger.vertices.erase(std::unique(larger.vertices.begin(), larger.vertices.end()),
                          larger.vertices.end());
  }
}

std::vector<CellWriter::FacetShape> CellWriter::shapes_of(
    std::span<const CellFacet> cell_facets) const {
  std::vector<FacetShape> shapes(cell_facets.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const CellFacet here = cell_facets[i];
    for (const Loop& loop : out_.cells[here.cell.index()].facets[at(here.facet)].loops) {
      Outline& outline = shapes[i].outlines.emplace_back();
      outline.reserve(loop.size());
      for (const int v : loop) outline.push_back(out_.vertices[at(v)].point);
      for (const Vec3 p : outline) shapes[i].box.grow(p);
    }
  }
  return shapes;
}

/// The shape that holds most of a polygon.
std::size_t CellWriter::home_of(const Building& building, const Polygon& polygon,
                                std::span<const FacetShape> shapes, Vec3 normal) const {
  Box box;
  for (const int v : polygon.rings[0]) box.grow(building.vertices[at(v)]);
  // That of the corners on the grid: of two numbers the lesser one is not rounded to more.
  box = {exact::on_grid(box.min, out_.grid_m), exact::on_grid(box.max, out_.grid_m)};
  boost::container::small_vector<std::size_t, 8> near;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    if (may_overlap(box, shapes[i].box, normal)) near.push_back(i);
  if (near.empty()) return 0;
  if (near.size() == 1) return near[0];
  const std::vector<Outline> rings = outlines_of(building, polygon, out_.grid_m);
  std::vector<int> hits(shapes.size(), 0);
  for (const Vec3 p : samples_of(rings, normal))
    for (const std::size_t i : near) {
      const auto& outlines = shapes[i].outlines;
      if (may_overlap(Box{p, p}, shapes[i].box, normal) &&
          contains({outlines.data(), outlines.size()}, normal, p))
        ++hits[i];
    }
  return static_cast<std::size_t>(std::ranges::max_element(hits) - hits.begin());
}

const std::vector<FeatureId>& CellWriter::features_around(FeatureId innermost) {
  if (innermost == innermost_) return around_;
  innermost_ = innermost;
  around_.clear();
  const auto add = [&](FeatureId id) {
    if (id.is_valid() && std::ranges::find(around_, id) == around_.end()) around_.push_back(id);
  };
  add(innermost);
  for (std::size_t i = 0; i < around_.size(); ++i) {
    const Feature& feature = out_.features[around_[i].index()];
    add(feature.parent);
    add(feature.host);
  }
  return around_;
}

void CellWriter::give(std::span<const int> polygons, const CellFacet& home) {
  if (polygons.empty()) return;
  const auto add_to = [&](std::vector<int>& all) {
    constexpr std::size_t kFew = 8;  // a window has no more
    if (all.empty() && polygons.size() < kFew) all.reserve(kFew);
    for (const int polygon : polygons) all.push_back(polygon);
  };
  Cell& cell = out_.cells[home.cell.index()];
  auto& here = cell.facets[at(home.facet)].polygons;
  here.insert(here.end(), polygons.begin(), polygons.end());
  if (here.size() > 1) std::ranges::sort(here);
  for (const FeatureId id : features_around(cell.feature))
    add_to(out_.features[id.index()].source_polygons);
}

/// Every input polygon goes to the cell facet that holds most of it, and to the features that facet
/// is in: those of its cell, what those lie in, and what hosts them.
void CellWriter::attribute_polygons(const Building& building, const Solid& solid) {
  std::vector<const Polygon*> polygon_of_source;  // made when it is asked for
  for (const FacetId source : made_of_.ids()) {
    const std::span<const CellFacet> cell_facets{made_of_[source].data(), made_of_[source].size()};
    const Facet& facet = solid.facets[source.index()];
    if (cell_facets.size() == 1) give(facet.polygons, cell_facets[0]);
    if (cell_facets.size() <= 1) continue;
    if (polygon_of_source.empty()) polygon_of_source = polygon_of_each_source(building);
    const Vec3 normal = solid.planes[facet.plane.index()].normal;
    const std::vector<FacetShape> shapes = shapes_of(cell_facets);
    for (const int& polygon : facet.polygons)
      give({&polygon, 1},
           cell_facets[home_of(building, *polygon_of_source[at(polygon)], shapes, normal)]);
  }
  for (Feature& feature : out_.features) {
    auto& polygons = feature.source_polygons;
    if (!std::ranges::is_sorted(polygons)) std::ranges::sort(polygons);
    polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
  }
}

}  // namespace oriel::detail
