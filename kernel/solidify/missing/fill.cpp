#include "kernel/solidify/missing/fill.h"

#include "kernel/base/index.h"
#include "kernel/solidify/cap_kinds.h"
#include "kernel/solidify/mend/duplicates.h"
#include "kernel/solidify/mend/t_vertices.h"
#include "kernel/solidify/missing/fits.h"
#include "kernel/solidify/missing/missing_faces.h"
#include "kernel/solidify/soup/polygon_shape.h"

#include <algorithm>
#include <utility>

namespace oriel::detail {

namespace {

/// The polygons as they meet each other: each once, with the vertices that lie on their edges.
Soup joined(const Soup& soup, double weld, RepairReport& report) {
  auto [whole, inserted] = insert_t_vertices(without_duplicates(soup, report.duplicates), weld);
  report.t_vertices = inserted;
  return std::move(whole);
}

Cap missing_cap(const Soup& soup, const MissingFace& face, const CapKinds& kinds) {
  Cap cap{face.area * soup.grid_m * soup.grid_m, {}, kinds.kind_of(face.rings)};
  for (const int v : face.rings[0])
    cap.centre = cap.centre + exact::to_metres(soup.points[at(v)], soup.grid_m);
  cap.centre = 1.0 / static_cast<double>(face.rings[0].size()) * cap.centre;
  return cap;
}

}  // namespace

std::optional<FilledShell> fill_missing_faces(const Soup& welded, const std::string& building,
                                              const Tolerances& tolerances, Work& work) {
  FilledShell filled;
  filled.report.was_needed = true;
  Soup soup = joined(welded, tolerances.weld_m / welded.grid_m, filled.report);
  ShellMesh mesh = build_shell_mesh(soup, building, filled.issues);
  if (has_errors(filled.issues)) return std::nullopt;
  const double reach = tolerances.plane_offset_m / soup.grid_m;
  auto faces = find_missing_faces(soup, mesh, shapes_of(soup), reach, work);
  if (!faces) return std::nullopt;
  std::vector<AddedFace> added;
  for (const MissingFace& face : *faces) added.push_back({face.rings, face.beside});
  const auto shapes = shapes_of(soup);
  const CapKinds kinds(soup, shapes, added, reach, work);
  for (const MissingFace& face : *faces)
    filled.report.caps.push_back(missing_cap(soup, face, kinds));
  filled.soup = with_faces(soup, std::move(added));
  if (!fits(filled.soup, shapes_of(filled.soup), reach, work)) return std::nullopt;
  filled.mesh = build_shell_mesh(filled.soup, building, filled.issues);
  if (has_errors(filled.issues) ||
      std::ranges::find(filled.mesh.twin, -1) != filled.mesh.twin.end())
    return std::nullopt;
  return filled;
}

}  // namespace oriel::detail
