#include "examples/generator/output/check.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace oriel::generator {
namespace {

/// A polygon's edge, and the corner it leaves.
struct HalfEdge {
  int from = 0, to = 0, polygon = 0;
  /// The half-edge that follows in its ring, and the one in the other direction.
  int next = -1, twin = -1;
};

std::vector<HalfEdge> half_edges(const Body& body) {
  std::vector<HalfEdge> edges;
  edges.reserve(body.vertices.size() * 4);
  for (std::size_t i = 0; i < body.polygons.size(); ++i)
    for (const std::vector<int>& ring : body.polygons[i].rings) {
      const int first = static_cast<int>(edges.size()), size = static_cast<int>(ring.size());
      for (int k = 0; k < size; ++k) {
        const int next = (k + 1) % size;
        edges.push_back({ring[at(k)], ring[at(next)], static_cast<int>(i), first + next, -1});
      }
    }
  return edges;
}

/// Disjoint sets of numbers.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  int root(int i) {
    while (parent_[at(i)] != i) i = parent_[at(i)] = parent_[at(parent_[at(i)])];
    return i;
  }
  void join(int a, int b) { parent_[at(root(a))] = root(b); }
  [[nodiscard]] std::size_t count() {
    std::size_t roots = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i)
      if (parent_[i] == static_cast<int>(i)) ++roots;
    return roots;
  }

 private:
  std::vector<int> parent_;
};

class Checker {
 public:
  Checker(const Body& body, std::optional<Um> flatness) : body_(body), flatness_(flatness) {}

  std::vector<std::string> run() {
    check_rings();
    if (!faults_.empty()) return std::move(faults_);
    check_edges();
    if (!faults_.empty()) return std::move(faults_);
    check_connection();
    check_planes();
    if (!(volume_m3(body_) > 0)) say("the volume is not positive");
    check_truth();
    return std::move(faults_);
  }

 private:
  void say(std::string fault) { faults_.push_back(std::move(fault)); }
  [[nodiscard]] std::string name(std::size_t polygon) const {
    const Owner owner = body_.polygons[polygon].owner;
    return "polygon " + std::to_string(polygon) + " of " + body_.objects[at(owner.object)].name;
  }

  void check_rings();
  void check_edges();
  void check_connection();
  void check_planes();
  void check_truth();

  const Body& body_;
  std::optional<Um> flatness_;
  std::vector<HalfEdge> edges_;
  std::vector<std::string> faults_;
};

void Checker::check_rings() {
  std::vector<int> sorted;
  for (std::size_t i = 0; i < body_.polygons.size(); ++i) {
    sorted.clear();
    for (const std::vector<int>& ring : body_.polygons[i].rings) {
      if (ring.size() < 3) say(name(i) + " has a ring of less than three corners");
      sorted.insert(sorted.end(), ring.begin(), ring.end());
    }
    std::sort(sorted.begin(), sorted.end());
    if (sorted.empty()) say(name(i) + " has no ring");
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      say(name(i) + " meets a vertex twice");
  }
}

void Checker::check_edges() {
  edges_ = half_edges(body_);
  // Both directions of an edge get the same key and so stand side by side.
  std::vector<std::pair<std::uint64_t, int>> order(edges_.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const auto [low, high] = std::minmax(edges_[i].from, edges_[i].to);
    order[i] = {at(low) << 32U | at(high), static_cast<int>(i)};
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() && order[end].first == order[i].first) ++end;
    HalfEdge& a = edges_[at(order[i].second)];
    HalfEdge& b = edges_[at(order[end - 1].second)];
    if (end - i != 2)
      say(name(at(a.polygon)) + " has an edge shared by " + std::to_string(end - i));
    else if (a.from == b.from)
      say(name(at(a.polygon)) + " has an edge that runs as its neighbour's");
    a.twin = order[end - 1].second;
    b.twin = order[i].second;
    i = end;
  }
}

/// Corners that are neighbours around a vertex are joined: one set per vertex is one fan. Polygons
/// that share an edge are joined: one set is one connected shell.
void Checker::check_connection() {
  Sets corners(edges_.size()), shells(body_.polygons.size());
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const HalfEdge& edge = edges_[i];
    const HalfEdge& twin = edges_[at(edge.twin)];
    corners.join(static_cast<int>(i), twin.next);
    shells.join(edge.polygon, twin.polygon);
  }
  if (corners.count() != body_.vertices.size())
    say("a vertex is not surrounded by one fan of polygons");
  if (shells.count() != 1) say("the surface has " + std::to_string(shells.count()) + " parts");
}

void Checker::check_planes() {
  for (std::size_t i = 0; i < body_.polygons.size(); ++i) {
    const Polygon& polygon = body_.polygons[i];
    const Vec3 area = doubled_area(body_, polygon);
    const Vec3 normal = normalised(area);
    if (length(normal) == 0) say(name(i) + " has no area");
    const Point origin = body_.vertices[at(polygon.rings[0][0])];
    double off = 0;
    for (const std::vector<int>& ring : polygon.rings) {
      for (const int vertex : ring)
        off = std::max(off, std::abs(dot(normal, metres(body_.vertices[at(vertex)] - origin))));
      const bool is_outer = &ring == &polygon.rings[0];
      const double sign = dot(normal, doubled_area(body_, ring));
      if ((sign > 0) != is_outer) say(name(i) + " has a ring that runs the wrong way");
    }
    if (flatness_ && off > metres(*flatness_)) say(name(i) + " is not planar");
  }
}

void Checker::check_truth() {
  const int count = static_cast<int>(body_.objects.size());
  std::vector<bool> has_polygon(body_.objects.size(), false);
  for (const Polygon& polygon : body_.polygons)
    if (!polygon.owner.is_niche) has_polygon[at(polygon.owner.object)] = true;
  for (std::size_t i = 0; i < body_.objects.size(); ++i) {
    const Object& object = body_.objects[i];
    if (!has_polygon[i]) say(object.name + " has no polygons");
    if (object.host >= count || object.parent >= count) say(object.name + " has no such host");
    if (!is_surface(object.kind) && object.host < 0) say(object.name + " has no host");
    if (is_opening(object.kind) && !object.recess) say(object.name + " has no recess");
  }
}

}  // namespace

std::vector<std::string> find_faults(const Body& body, std::optional<Um> flatness) {
  return Checker(body, flatness).run();
}

}  // namespace oriel::generator
