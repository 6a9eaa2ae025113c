#include "kernel/mesh/level_distance.h"

#include "kernel/base/index.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/planar.h"
#include "kernel/mesh/triangulate.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <queue>
#include <ranges>
#include <tuple>
#include <utility>
#include <vector>

namespace oriel {

namespace {

using Corners = std::array<Vec3, 3>;
using PointRing = std::vector<std::array<double, 3>>;

double distance_to(Vec3 p, const Corners& t) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double size = length(normal);
  bool is_above = size > 0;
  for (std::size_t i = 0; i < 3 && is_above; ++i)
    is_above = dot(cross(t[(i + 1) % 3] - t[i], p - t[i]), normal) >= 0;
  if (is_above) return std::abs(dot(p - t[0], normal)) / size;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i)
    least = std::min(least, distance_to_segment(p, t[i], t[(i + 1) % 3]));
  return least;
}

}  // namespace

namespace detail {

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
    const Box here{point, point};
    tree_.search([&](const Box& box) { return distance_m(here, box) < best.distance; },
                 [&](int number) {
                   const double distance = distance_to(point, triangles_[at(number)]);
                   if (distance < best.distance) best = {point, distance, at(number)};
                 });
    return best;
  }
  [[nodiscard]] const Corners& triangle(std::size_t number) const { return triangles_[number]; }
  [[nodiscard]] const std::vector<Corners>& triangles() const { return triangles_; }

 private:
  static std::vector<Box> boxes_of(const std::vector<Corners>& triangles) {
    std::vector<Box> boxes(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
      for (const Vec3 p : triangles[i]) boxes[i].grow(p);
    return boxes;
  }

  std::vector<Corners> triangles_;
  BoxTree tree_;
};

}  // namespace detail

namespace {

using detail::MeasuredSurface;

/// Looks for the point of some triangles that is farthest from a surface.
class FarthestPoint {
 public:
  /// `known`: farther than this something is already.
  FarthestPoint(const MeasuredSurface& surface, double error_m, double known)
      : surface_(surface), error_m_(error_m), greatest_(known) {}

  double find(const std::vector<Corners>& triangles) {
    for (const Corners& triangle : triangles) probe(triangle[0]);
    for (const Corners& triangle : triangles) {
      const double way =
          std::max(length(triangle[1] - triangle[0]), length(triangle[2] - triangle[0]));
      if (probe(triangle[0]).distance + way > greatest_ + error_m_)
        push({probe(triangle[0]), probe(triangle[1]), probe(triangle[2])});
    }
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

  /// Of a corner, which several triangles have.
  const MeasuredSurface::Probe& probe(Vec3 corner) {
    const auto [found, is_new] = known_.try_emplace({corner.x, corner.y, corner.z});
    if (!is_new) return found->second;
    found->second = surface_.probe(corner, near_);
    near_ = found->second.nearest;
    greatest_ = std::max(greatest_, found->second.distance);
    return found->second;
  }

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
  std::size_t near_ = 0;  ///< where the last corner was near
  std::map<std::array<double, 3>, MeasuredSurface::Probe> known_;
  std::priority_queue<TrianglePiece> waiting_;
};

}  // namespace

struct LevelSurface::Parts {
  /// A facet by its points, however they are numbered and wherever its rings begin.
  struct FacetForm {
    PointRing outer;
    std::map<PointRing, const Loop*> holes;
  };

  explicit Parts(Solid level) : solid(std::move(level)) {
    for (const Vertex& vertex : solid.vertices) points.push_back(vertex.point);
    std::vector<Corners> triangles;
    for (const Facet& facet : solid.facets) {
      forms.push_back(form_of(facet));
      facet_at.emplace(forms.back().outer, forms.size() - 1);
      first_triangle.push_back(triangles.size());
      triangulate(facet, facet.loops, triangles);
    }
    first_triangle.push_back(triangles.size());
    surface.emplace(std::move(triangles));
  }

  /// Triangles that cover all that may not lie on `other`.
  [[nodiscard]] std::vector<Corners> triangles_beyond(const Parts& other) const {
    std::vector<Corners> out;
    for (std::size_t f = 0; f < forms.size(); ++f) {
      const auto same = other.facet_at.find(forms[f].outer);
      if (same != other.facet_at.end() && add_holes(forms[f], other, same->second, out)) continue;
      const auto all = surface->triangles().begin();
      out.insert(out.end(), all + static_cast<std::ptrdiff_t>(first_triangle[f]),
                 all + static_cast<std::ptrdiff_t>(first_triangle[f + 1]));
    }
    return out;
  }

  Solid solid;
  std::vector<Vec3> points{};
  std::vector<FacetForm> forms{};               ///< parallel to the facets
  std::vector<std::size_t> first_triangle{};    ///< of each facet, and behind the last
  std::map<PointRing, std::size_t> facet_at{};  ///< by outer ring
  std::optional<MeasuredSurface> surface{};

 private:
  [[nodiscard]] FacetForm form_of(const Facet& facet) const {
    FacetForm form;
    for (const Loop& loop : facet.loops) {
      PointRing ring;
      for (const int v : loop) ring.push_back({points[at(v)].x, points[at(v)].y, points[at(v)].z});
      std::ranges::rotate(ring, std::ranges::min_element(ring));
      if (&loop == &facet.loops.front())
        form.outer = std::move(ring);
      else
        form.holes.emplace(std::move(ring), &loop);
    }
    return form;
  }

  /// What a facet has that another one with the same outer ring lacks: holes of that one. False if
  /// it has holes of its own besides, which may reach into those.
  static bool add_holes(const FacetForm& form, const Parts& other, std::size_t number,
                        std::vector<Corners>& out) {
    const auto& holes = other.forms[number].holes;
    const auto own_rings = form.holes | std::views::keys, rings = holes | std::views::keys;
    if (std::ranges::includes(own_rings, rings)) return true;
    if (!std::ranges::includes(rings, own_rings)) return false;
    for (const auto& [ring, loop] : holes)
      if (!form.holes.contains(ring))
        other.triangulate(other.solid.facets[number], {Loop(loop->rbegin(), loop->rend())}, out);
    return true;
  }

  void triangulate(const Facet& facet, const std::vector<Loop>& loops,
                   std::vector<Corners>& out) const {
    const Vec3 normal = solid.planes[facet.plane.index()].normal;
    for (const auto& [a, b, c] : triangulate_quickly(points, loops, normal))
      out.push_back({points[at(a)], points[at(b)], points[at(c)]});
  }
};

LevelSurface::LevelSurface(Solid level) : parts_(std::make_shared<const Parts>(std::move(level))) {}

double level_distance_m(const LevelSurface& a, const LevelSurface& b, double error_m) {
  double distance_m = 0;
  for (const auto& [from, to] : {std::pair(&*a.parts_, &*b.parts_), {&*b.parts_, &*a.parts_}}) {
    const auto changed = from->triangles_beyond(*to);
    if (!changed.empty())
      distance_m = FarthestPoint(*to->surface, error_m, distance_m).find(changed);
  }
  return distance_m;
}

double level_distance_m(const Solid& a, const Solid& b, double error_m) {
  return level_distance_m(LevelSurface(a), LevelSurface(b), error_m);
}

}  // namespace oriel
