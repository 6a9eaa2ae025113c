#include "kernel/validate/solids/closed_surface.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <CGAL/Exact_integer.h>
#include <CGAL/Homogeneous.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>

namespace oriel::detail {

namespace {

using NefKernel = CGAL::Homogeneous<CGAL::Exact_integer>;
using Polyhedron = CGAL::Polyhedron_3<NefKernel>;
using Nef = CGAL::Nef_polyhedron_3<NefKernel>;

/// Puts a closed surface into a half-edge structure.
class Build : public CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
 public:
  explicit Build(const ClosedSurface& surface) : surface_(surface) {}

  void operator()(Polyhedron::HalfedgeDS& structure) override {
    CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(structure, true);
    builder.begin_surface(surface_.points().size(), surface_.corners().size());
    for (const MicrometrePoint& p : surface_.points())
      builder.add_vertex(NefKernel::Point_3(CGAL::Exact_integer(static_cast<double>(p[0])),
                                            CGAL::Exact_integer(static_cast<double>(p[1])),
                                            CGAL::Exact_integer(static_cast<double>(p[2]))));
    for (const auto& corners : surface_.corners())
      builder.add_facet(corners.begin(), corners.end());
    builder.end_surface();
  }

 private:
  const ClosedSurface& surface_;
};

Nef nef_of(const ClosedSurface& surface) {
  Polyhedron polyhedron;
  Build build(surface);
  polyhedron.delegate(build);
  return Nef(polyhedron);
}

/// relate() of bodies whose surfaces touch, by Nef polyhedra.
SurfaceRelation relate_by_nef(const ClosedSurface& first, const ClosedSurface& second) {
  const Nef p = nef_of(first);
  const Nef q = nef_of(second);
  SurfaceRelation out;
  out.do_touch = true;
  out.do_overlap = !(p.interior() * q.interior()).is_empty();
  out.is_second_inside = (q.interior() - p).is_empty();
  out.are_alike = out.is_second_inside && (p.interior() - q).is_empty();
  out.share_a_face = (p.boundary() * q.boundary()).number_of_facets() > 0;
  return out;
}

/// count_pieces() by Nef polyhedra.
int count_pieces_by_nef(const ClosedSurface& outer,
                        std::span<const ClosedSurface* const> cavities) {
  Nef rest = nef_of(outer).interior();
  for (const ClosedSurface* cavity : cavities) rest -= nef_of(*cavity);
  // Volumes are the pieces of space: those of the rest are marked.
  int count = 0;
  for (auto volume = rest.volumes_begin(); volume != rest.volumes_end(); ++volume)
    if (volume->mark()) ++count;
  return count;
}

using exact::Int128;

/// Six times the volume under a triangle as seen from `o`.
Int128 volume_under(const MicrometreTriangle& t, const MicrometrePoint& o) {
  std::array<std::array<Int128, 3>, 3> v{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) v[i][j] = t[i][j] - o[j];
  return v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
         v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
         v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
}

std::vector<Box> boxes_of(std::span<const MicrometreTriangle> triangles) {
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const MicrometreTriangle& triangle : triangles) boxes.push_back(box_of(triangle));
  return boxes;
}

std::vector<MicrometreTriangle> triangles_of(std::span<const MicrometrePoint> points,
                                             std::span<const std::array<int, 3>> corners) {
  std::vector<MicrometreTriangle> triangles;
  triangles.reserve(corners.size());
  const auto point = [&](int i) { return points[static_cast<std::size_t>(i)]; };
  for (const auto& [a, b, c] : corners) triangles.push_back({point(a), point(b), point(c)});
  return triangles;
}

}  // namespace

ClosedSurface::ClosedSurface(const SnappedBuilding& building, const JudgedShell& shell)
    : tree_({}) {
  std::map<int, int> local_of;
  for (const ShellPolygon& polygon : shell.polygons)
    for (std::array<int, 3> corners : polygon.triangles) {
      for (int& corner : corners) {
        const auto [found, is_new] = local_of.try_emplace(corner, static_cast<int>(points_.size()));
        if (is_new) points_.push_back(building.point(corner));
        corner = found->second;
      }
      corners_.push_back(corners);
    }
  ORIEL_ASSERT(!points_.empty(), "a shell that passed has triangles");
  Int128 volume = 0;
  for (const MicrometreTriangle& triangle : triangles_of(points_, corners_))
    volume += volume_under(triangle, points_[0]);
  orientation_ = volume > 0 ? 1 : -1;
  if (orientation_ < 0)
    for (auto& corners : corners_) std::swap(corners[1], corners[2]);
  triangles_ = triangles_of(points_, corners_);
  box_ = box_of(points_);
  tree_ = BoxTree(boxes_of(triangles_));
}

bool ClosedSurface::contains(const MicrometrePoint& point) const {
  if (!overlap(box_, box_of(std::array{point}))) return false;
  // A ray to a point beyond the box; if it runs along a triangle or through an edge, the next one.
  for (std::int64_t attempt = 1;; ++attempt) {
    const MicrometrePoint far{static_cast<std::int64_t>(box_.max.x) + 1 + 17 * attempt,
                              point[1] + 1009 * attempt, point[2] + 919 * attempt * attempt};
    const Box reach = box_of(std::array{point, far});
    bool is_clear = true;
    int crossings = 0;
    tree_.for_each_overlap(reach, [&](int i) {
      const MicrometreTriangle& t = triangles_[at(i)];
      if (!meets(point, far, t)) return;
      const bool is_inner =
          side_of(t[0], t[1], t[2], point) != 0 && side_of(point, far, t[0], t[1]) != 0 &&
          side_of(point, far, t[1], t[2]) != 0 && side_of(point, far, t[2], t[0]) != 0;
      is_clear = is_clear && is_inner;
      ++crossings;
    });
    if (is_clear) return crossings % 2 == 1;
  }
}

namespace {

/// What a triangle costs in a Nef polyhedron: a millisecond.
constexpr std::int64_t kStepsPerNefTriangle = 40'000;

bool may_make_nef(std::size_t triangles, Work& work) {
  work.add(kStepsPerNefTriangle * static_cast<std::int64_t>(triangles));
  return !work.is_used_up();
}

}  // namespace

SurfaceRelation relate(const ClosedSurface& first, const ClosedSurface& second, Work& work) {
  bool do_pierce = false;
  SurfaceRelation out;
  for (const MicrometreTriangle& triangle : second.triangles()) {
    if (do_pierce || work.is_used_up()) break;
    first.tree().for_each_overlap(box_of(triangle), [&](int i) {
      work.add(1);
      if (do_pierce || work.is_used_up()) return;
      const MicrometreTriangle& other = first.triangles()[at(i)];
      out.do_touch = out.do_touch || meet(other, triangle);
      do_pierce = pierce(other, triangle);
    });
  }
  if (work.is_used_up()) return out;
  if (do_pierce) {
    out.do_touch = out.do_overlap = true;
    return out;
  }
  if (out.do_touch)
    return may_make_nef(first.corners().size() + second.corners().size(), work)
               ? relate_by_nef(first, second)
               : out;
  out.is_second_inside = first.contains(second.points()[0]);
  out.do_overlap = out.is_second_inside || second.contains(first.points()[0]);
  return out;
}

int count_pieces(const ClosedSurface& outer, std::span<const ClosedSurface* const> cavities,
                 Work& work) {
  std::size_t triangles = outer.corners().size();
  for (const ClosedSurface* cavity : cavities) triangles += cavity->corners().size();
  if (!may_make_nef(triangles, work)) return 1;
  return count_pieces_by_nef(outer, cavities);
}

}  // namespace oriel::detail
