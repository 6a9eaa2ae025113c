#include "kernel/mesh/level_distance.h"

#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/mesh/triangulate.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace oriel {

namespace {

using Corners = std::array<Vec3, 3>;
/// The loops of a facet by their points, however they are numbered and wherever they begin.
using FacetForm = std::set<std::vector<std::array<double, 3>>>;

FacetForm form_of(const Solid& solid, const Facet& facet) {
  FacetForm form;
  for (const Loop& loop : facet.loops) {
    std::vector<std::array<double, 3>> points;
    for (const int v : loop) {
      const Vec3 p = solid.vertices[at(v)].point;
      points.push_back({p.x, p.y, p.z});
    }
    std::ranges::rotate(points, std::ranges::min_element(points));
    form.insert(std::move(points));
  }
  return form;
}

std::set<FacetForm> forms_of(const Solid& solid) {
  std::set<FacetForm> forms;
  for (const Facet& facet : solid.facets) forms.insert(form_of(solid, facet));
  return forms;
}

/// The triangles of the facets that `is_asked` says yes to.
template <class IsAsked>
std::vector<Corners> triangles_of(const Solid& solid, const IsAsked& is_asked) {
  std::vector<Vec3> points;
  for (const Vertex& vertex : solid.vertices) points.push_back(vertex.point);
  std::vector<Corners> out;
  for (const Facet& facet : solid.facets) {
    if (!is_asked(facet)) continue;
    const Vec3 normal = solid.planes[facet.plane.index()].normal;
    for (const auto& [a, b, c] : detail::triangulate(points, facet.loops, normal))
      out.push_back({points[at(a)], points[at(b)], points[at(c)]});
  }
  return out;
}

/// Of a point from a segment.
Vec3 nearest_on_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 way = b - a;
  const double size = dot(way, way);
  const double along = size > 0 ? std::clamp(dot(p - a, way) / size, 0.0, 1.0) : 0;
  return a + along * way;
}

double distance_to(Vec3 p, const Corners& t) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double size = length(normal);
  bool is_above = size > 0;
  for (std::size_t i = 0; i < 3 && is_above; ++i)
    is_above = dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) >= 0;
  if (is_above) return std::abs(dot(p - t[0], normal)) / size;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
    least = std::min(least, length(p - nearest_on_segment(p, t[i], t[(i + 1) % 3])));
  return least;
}

double distance_to(Vec3 p, const Box& box) {
  const auto beyond = [](double x, double least, double most) {
    return std::max({least - x, x - most, 0.0});
  };
  return length({beyond(p.x, box.min.x, box.max.x), beyond(p.y, box.min.y, box.max.y),
                 beyond(p.z, box.min.z, box.max.z)});
}

/// A surface to which distances are measured.
class MeasuredSurface {
 public:
  /// A point, how far the surface is, and which triangle of it is the nearest.
  struct Probe {
    Vec3 point;
    double distance = 0;
    std::size_t nearest = 0;
  };

  explicit MeasuredSurface(std::vector<Corners> triangles)
      : triangles_(std::move(triangles)), tree_(boxes_of(triangles_)) {}

  /// `near`: a triangle that is probably near, from which the search begins.
  [[nodiscard]] Probe probe(Vec3 point, std::size_t near) const {
    Probe best{point, distance_to(point, triangles_[near]), near};
    tree_.search([&](const Box& box) { return distance_to(point, box) < best.distance; },
                 [&](int number) {
                   const double distance = distance_to(point, triangles_[at(number)]);
                   if (distance < best.distance) best = {point, distance, at(number)};
                 });
    return best;
  }
  [[nodiscard]] const Corners& triangle(std::size_t number) const { return triangles_[number]; }

 private:
  static std::vector<Box> boxes_of(const std::vector<Corners>& triangles) {
    std::vector<Box> boxes(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (const Vec3 p : triangles[i]) boxes[i].grow(p);
    return boxes;
  }

  std::vector<Corners> triangles_;
  detail::BoxTree tree_;
};

/// Looks for the point of some triangles that is farthest from a surface.
class FarthestPoint {
 public:
  /// `known`: farther than this something is already.
  FarthestPoint(const MeasuredSurface& surface, double error_m, double known)
      : surface_(surface), error_m_(error_m), greatest_(known) {}

  double find(const std::vector<Corners>& triangles) {
    std::size_t near = 0;
    std::vector<Probes> all;
    for (const Corners& triangle : triangles) {
      Probes probes;
      for (std::size_t i = 0; i < 3; ++i) {
        probes[i] = surface_.probe(triangle[i], near);
        near = probes[i].nearest;
        greatest_ = std::max(greatest_, probes[i].distance);
      }
      all.push_back(probes);
    }
    for (const Probes& probes : all) push(probes);
    while (!waiting_.empty() && waiting_.top().most > greatest_ + error_m_) {
      const Probes probes = waiting_.top().probes;
      waiting_.pop();
      quarter(probes);
    }
    return greatest_;
  }

 private:
  using Probes = std::array<MeasuredSurface::Probe, 3>;
  struct TrianglePiece {
    double most = 0;  ///< no point of it is farther
    std::size_t number = 0;
    Probes probes;
    bool operator<(const TrianglePiece& other) const {
      return std::tie(most, other.number) < std::tie(other.most, number);
    }
  };

  void push(const Probes& probes) {
    const double most = most_of(probes);
    if (most > greatest_ + error_m_) waiting_.push({most, ++pushed_, probes});
  }

  /// The least of what is known: the farthest corner from one triangle of the surface, which is
  /// convex; and no point is farther from the surface than a corner of it and the way to that.
  [[nodiscard]] double most_of(const Probes& probes) const {
    double most = std::numeric_limits<double>::infinity();
    for (const auto& from : probes) {
      double to_triangle = 0, way = 0;
      for (const auto& probe : probes) {
        to_triangle =
            std::max(to_triangle, distance_to(probe.point, surface_.triangle(from.nearest)));
        way = std::max(way, length(probe.point - from.point));
      }
      most = std::min({most, to_triangle, from.distance + way});
    }
    return most;
  }

  void quarter(const Probes& probes) {
    Probes middles;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 middle = 0.5 * (probes[i].point + probes[(i + 1) % 3].point);
      middles[i] = surface_.probe(middle, probes[i].nearest);
      greatest_ = std::max(greatest_, middles[i].distance);
    }
    for (std::size_t i = 0; i < 3; ++i) push({probes[i], middles[i], middles[(i + 2) % 3]});
    push(middles);
  }

  const MeasuredSurface& surface_;
  double error_m_;
  double greatest_;
  std::size_t pushed_ = 0;
  std::priority_queue<TrianglePiece> waiting_;
};

}  // namespace

double level_distance_m(const Solid& a, const Solid& b, double error_m) {
  const std::set<FacetForm> forms_a = forms_of(a), forms_b = forms_of(b);
  const auto all = [](const Facet&) { return true; };
  double distance_m = 0;
  for (const auto& [from, to, known] :
       {std::tuple(&a, &b, &forms_b), std::tuple(&b, &a, &forms_a)}) {
    const auto changed = triangles_of(*from, [&, from = from, known = known](const Facet& facet) {
      return !known->contains(form_of(*from, facet));
    });
    if (changed.empty()) continue;
    const MeasuredSurface surface(triangles_of(*to, all));
    distance_m = FarthestPoint(surface, error_m, distance_m).find(changed);
  }
  return distance_m;
}

}  // namespace oriel
