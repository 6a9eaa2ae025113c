#include "kernel/validate/solids/nef_bodies.h"

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

}  // namespace

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

int count_pieces_by_nef(const ClosedSurface& outer,
                        const std::vector<const ClosedSurface*>& cavities) {
  Nef rest = nef_of(outer).interior();
  for (const ClosedSurface* cavity : cavities) rest -= nef_of(*cavity);
  // Volumes are the pieces of space: those of the rest are marked.
  int count = 0;
  for (auto volume = rest.volumes_begin(); volume != rest.volumes_end(); ++volume)
    if (volume->mark()) ++count;
  return count;
}

}  // namespace oriel::detail
