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

/// Every edge has two half-edges, or the open loops are counted and named.
void check_closed(const Building& building, const Soup& soup, const ShellMesh& mesh,
                  std::vector<Issue>& issues) {
  const auto first = std::ranges::find(mesh.twin, -1);
  if (first == mesh.twin.end()) return;
  std::vector<char> is_seen(mesh.half_edge_count(), 0);
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  int edges = 0, loops = 0;
  for (int start = 0; start < std::ssize(mesh.twin); ++start) {
    if (mesh.twin[at(start)] >= 0 || is_seen[at(start)]) continue;
    ++loops;
    for (int h = start; !is_seen[at(h)];) {
      is_seen[at(h)] = 1;
      ++edges;
      h = mesh.next[at(h)];
      while (mesh.twin[at(h)] >= 0) h = mesh.next[at(mesh.twin[at(h)])];
    }
  }
  const int end = mesh.next[static_cast<std::size_t>(first - mesh.twin.begin())];
  issues.push_back(
      error(building, "E302",
            fmt::format("not closed: {} open edges in {} loops, the first at {} (val3dity 302)",
                        edges, loops, detail::place_text(soup, soup.corners[at(end)]))));
}

/// What the input says of every component: of its last facet, of the facet's first polygon.
std::vector<detail::ComponentHint> hints_of(const Building& building, const Soup& soup,
                                            const detail::FacetDraft& draft) {
  std::vector<const detail::SoupPolygon*> first_of(draft.facet_count(), nullptr);
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    auto& first = first_of[static_cast<std::size_t>(draft.facet_of[p])];
    if (first == nullptr || soup.polygons[p].source <= first->source) first = &soup.polygons[p];
  }
  std::vector<detail::ComponentHint> hints(static_cast<std::size_t>(draft.components));
  for (std::size_t f = 0; f < first_of.size(); ++f)
    hints[static_cast<std::size_t>(draft.component[f])] = {
        first_of[f]->body, building.is_solid ? first_of[f]->shell : -1};
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

  const ShellMesh mesh = detail::build_shell_mesh(soup, building.id, out.issues);
  if (is_set_aside()) return out;
  check_closed(building, soup, mesh, out.issues);
  if (is_set_aside()) return out;

  const detail::PlaneClusters clusters = detail::cluster_planes(soup, mesh, tolerances);
  detail::FacetDraft draft = detail::draft_facets(soup, clusters, mesh);
  const auto hints = hints_of(building, soup, draft);
  detail::SnappedSolid snapped =
      detail::snap_vertices(soup, clusters, mesh, std::move(draft), tolerances);
  Solid& solid = snapped.solid;
  const int swallowed = snapped.swallowed + clusters.standing;
  if (swallowed > 0)
    out.issues.push_back(building_issue(
        Severity::warning, "E309", building.id,
        fmt::format("{} facets are thinner than the tolerances ({} m) and were swallowed",
                    swallowed, tolerances.plane_offset_m)));
  if (solid.facets.empty())
    out.issues.push_back(error(building, "E310", "nothing is left that encloses a volume"));
  if (is_set_aside()) return out;
  detail::arrange_shells(solid, snapped.component, hints, building.id, out.issues);
  const bool may_be_open = snapped.has_united || snapped.swallowed > 0;
  if (!is_set_aside() && may_be_open && !is_closed(solid))
    out.issues.push_back(error(
        building, "E302", "not closed after its vertices were put on their planes (val3dity 302)"));
  if (!is_set_aside()) out.value = std::move(solid);
  return out;
}

}  // namespace oriel
