#include "kernel/solidify/solidify.h"

#include "kernel/solidify/detail/facets.h"
#include "kernel/solidify/detail/plane_clusters.h"
#include "kernel/solidify/detail/shell_mesh.h"
#include "kernel/solidify/detail/shells.h"
#include "kernel/solidify/detail/snap.h"
#include "kernel/solidify/detail/soup.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace oriel {

namespace {

using detail::ShellMesh;
using detail::Soup;

Issue error(const Building& building, std::string code, std::string sentence) {
  return building_issue(Severity::error, std::move(code), building.id, std::move(sentence));
}

/// Refuses what the exact arithmetic has no room for.
void check_size(const Building& building, const Tolerances& tolerances,
                std::vector<Issue>& issues) {
  const double limit =
      static_cast<double>(exact::kMaxCoordinate) * detail::grid_for(tolerances.weld_m);
  double reach = 0;
  for (const Vec3 p : building.vertices)
    for (const double c : {p.x, p.y, p.z})
      reach = std::max(reach, std::isfinite(c) ? std::abs(c) : Box::kInfinity);
  if (!(reach <= limit))
    issues.push_back(error(building, "E501",
                           fmt::format("reaches {:.0f} m from its frame's origin, more than the "
                                       "{:.0f} m that weld_m = {} m allows",
                                       reach, limit, tolerances.weld_m)));
}

/// Every edge has two sides, or the open loops are counted and named.
void check_closed(const Building& building, const Soup& soup, const ShellMesh& shell,
                  std::vector<Issue>& issues) {
  const auto& mesh = shell.mesh;
  std::vector<char> is_seen(mesh.n_halfedges(), 0);
  int edges = 0, loops = 0, place = -1;
  for (const auto start : mesh.halfedges()) {
    if (!start.is_boundary() || is_seen[static_cast<std::size_t>(start.idx())]) continue;
    ++loops;
    if (place < 0)
      place = shell.point_of[static_cast<std::size_t>(mesh.from_vertex_handle(start).idx())];
    for (OpenMesh::HalfedgeHandle h = start; !is_seen[static_cast<std::size_t>(h.idx())];
         h = mesh.next_halfedge_handle(h)) {
      is_seen[static_cast<std::size_t>(h.idx())] = 1;
      ++edges;
    }
  }
  if (edges > 0)
    issues.push_back(
        error(building, "E302",
              fmt::format("not closed: {} open edges in {} loops, the first at {} (val3dity 302)",
                          edges, loops, detail::place_text(soup, place))));
}

/// What the input says of every component.
std::vector<detail::ComponentHint> hints_of(const Building& building, const Soup& soup,
                                            const detail::FacetDraft& draft) {
  std::vector<int> polygon_of(building.polygons.size(), -1);  // by source
  for (int p = 0; p < std::ssize(soup.polygons); ++p) {
    const auto source = static_cast<std::size_t>(soup.polygons[static_cast<std::size_t>(p)].source);
    if (source < polygon_of.size()) polygon_of[source] = p;
  }
  std::vector<detail::ComponentHint> hints(static_cast<std::size_t>(draft.components));
  for (std::size_t f = 0; f < draft.facets.size(); ++f) {
    const int p = polygon_of[static_cast<std::size_t>(draft.facets[f].polygons.front())];
    const auto& polygon = soup.polygons[static_cast<std::size_t>(p)];
    hints[static_cast<std::size_t>(draft.component[f])] = {polygon.body,
                                                           building.is_solid ? polygon.shell : -1};
  }
  return hints;
}

}  // namespace

Checked<Solid> solidify(const Building& building, const Tolerances& tolerances) {
  Checked<Solid> out;
  const auto is_set_aside = [&] { return has_errors(out.issues); };

  check_size(building, tolerances, out.issues);
  if (is_set_aside()) return out;
  Soup soup = detail::weld(building, tolerances, out.issues);
  if (soup.polygons.size() < 4)
    out.issues.push_back(error(
        building, "E301",
        fmt::format("{} polygons cannot enclose a volume (val3dity 301)", soup.polygons.size())));
  if (is_set_aside()) return out;

  const ShellMesh shell = detail::build_shell_mesh(soup, building.id, out.issues);
  if (is_set_aside()) return out;
  check_closed(building, soup, shell, out.issues);
  if (is_set_aside()) return out;

  const detail::PlaneClusters clusters = detail::cluster_planes(soup, tolerances);
  detail::FacetDraft draft = detail::draft_facets(soup, clusters, shell);
  const auto hints = hints_of(building, soup, draft);
  int swallowed = 0;
  Solid solid = detail::snap_vertices(soup, clusters, shell, draft, tolerances, swallowed);
  swallowed += clusters.standing;
  if (swallowed > 0)
    out.issues.push_back(building_issue(
        Severity::warning, "E309", building.id,
        fmt::format("{} facets are thinner than the tolerances ({} m) and were swallowed",
                    swallowed, tolerances.plane_offset_m)));
  if (solid.facets.empty())
    out.issues.push_back(error(building, "E310", "nothing is left that encloses a volume"));
  if (is_set_aside()) return out;
  detail::arrange_shells(solid, draft.component, hints, building.id, out.issues);
  if (!is_set_aside() && !is_closed(solid))
    out.issues.push_back(error(
        building, "E302", "not closed after its vertices were put on their planes (val3dity 302)"));
  if (!is_set_aside()) out.value = std::move(solid);
  return out;
}

}  // namespace oriel
