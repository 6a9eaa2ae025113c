#include "kernel/solidify/shells/solid_of_shells.h"

#include "kernel/base/text/counted.h"
#include "kernel/solidify/planes/plane_clusters.h"
#include "kernel/solidify/planes/snap.h"
#include "kernel/solidify/shells/facets.h"
#include "kernel/solidify/shells/shells.h"
#include "kernel/solidify/soup/polygon_shape.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// What the input says of every component, in whatever order it names its polygons. Where repair
/// made one of several, it is of the first body, and if that joined an exterior shell and a cavity
/// which of them it is, is not said.
std::vector<ComponentHint> hints_of(const Building& building, const Soup& soup,
                                    const FacetDraft& draft) {
  struct Said {
    std::optional<int> body;
    int least_shell = 0, most_shell = 0;
  };
  std::vector<Said> said(static_cast<std::size_t>(draft.components));
  for (std::size_t p = 0; p < soup.polygons.size(); ++p) {
    const SoupPolygon& polygon = soup.polygons[p];
    if (polygon.source == kNoSource) continue;
    Said& of = said[static_cast<std::size_t>(
        draft.component[static_cast<std::size_t>(draft.facet_of[p])])];
    of.least_shell = of.body ? std::min(of.least_shell, polygon.shell) : polygon.shell;
    of.most_shell = of.body ? std::max(of.most_shell, polygon.shell) : polygon.shell;
    of.body = of.body ? std::min(*of.body, polygon.body) : polygon.body;
  }
  std::vector<ComponentHint> hints;
  for (const Said& of : said) {
    const bool is_told = of.least_shell > 0 || of.most_shell == 0;
    hints.push_back({of.body.value_or(0), building.is_solid && is_told ? of.least_shell : -1});
  }
  return hints;
}

/// Of every polygon 1 if it closes a hole and is no sliver: facets of those would be folded on the
/// file's grid, and say nothing.
std::vector<char> caps_of(const Soup& soup, const Tolerances& tolerances) {
  const auto shapes = shapes_of(soup);
  const double thin = 2 * tolerances.plane_offset_m / soup.grid_m;
  std::vector<char> is_cap(soup.polygons.size(), 0);
  for (int p = 0; p < soup.polygon_count(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    is_cap[i] =
        soup.polygons[i].source == kNoSource && height_of(soup, p, shapes[i].area) > thin ? 1 : 0;
  }
  return is_cap;
}

}  // namespace

void add_solid(const Building& building, const Soup& soup, const ShellMesh& mesh,
               const Tolerances& tolerances, Solidified& out, Work& work, bool keeps_caps_apart) {
  const auto is_set_aside = [&] { return has_errors(out.issues); };
  const auto report = [&](Severity severity, Code code, std::string sentence) {
    out.issues.push_back(building_issue(severity, code, building.id, std::move(sentence)));
  };
  const PlaneClusters clusters = cluster_planes(soup, mesh, tolerances, work);
  FacetDraft draft = draft_facets(
      soup, clusters, mesh, keeps_caps_apart ? caps_of(soup, tolerances) : std::vector<char>{});
  const auto hints = hints_of(building, soup, draft);
  SnappedSolid snapped = snap_vertices(soup, clusters, mesh, std::move(draft), tolerances);
  Solid& solid = snapped.solid;
  const int swallowed = snapped.swallowed + clusters.standing;
  if (swallowed > 0)
    report(Severity::warning, Code::E309,
           fmt::format("{} thinner than the tolerances ({} m) and {} absorbed",
                       counted(swallowed, "facet is", "facets are"), tolerances.plane_offset_m,
                       agreeing(swallowed, "was", "were")));
  if (solid.facets.empty())
    report(Severity::error, Code::E310, "nothing is left that encloses a volume");
  if (is_set_aside()) return;
  arrange_shells(solid, snapped.component, hints, building.id, out.issues);
  const bool may_be_open = snapped.has_united || snapped.swallowed > 0;
  if (!is_set_aside() && may_be_open && !oriel::is_closed(solid))
    report(Severity::error, Code::E302,
           "not closed after its vertices were put on their planes (val3dity 302)");
  // Cavities that nearly are the shell around them may be larger than it.
  if (!is_set_aside() && volume_m3(solid) <= 0)
    report(Severity::error, Code::E310, "its cavities leave nothing that encloses a volume");
  if (!is_set_aside()) out.value = std::move(solid);
}

}  // namespace oriel::detail
