#include "kernel/solidify/solidify.h"

#include "kernel/base/text/counted.h"
#include "kernel/geometry/disjoint_sets.h"
#include "kernel/solidify/crossings/uncross.h"
#include "kernel/solidify/mend/mend.h"
#include "kernel/solidify/missing/fill.h"
#include "kernel/solidify/shells/shell_mesh.h"
#include "kernel/solidify/shells/solid_of_shells.h"
#include "kernel/solidify/soup/soup.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using detail::ShellMesh;

Issue error(const Building& building, Code code, std::string sentence) {
  return building_issue(Severity::error, code, building.id, std::move(sentence));
}

/// Refuses what the exact arithmetic has no room for.
void check_size(const Building& building, const Tolerances& tolerances,
                std::vector<Issue>& issues) {
  const double limit = static_cast<double>(exact::kMaxCoordinate) * grid_for(tolerances.weld_m);
  const auto fits = [limit](double c) { return std::abs(c) <= limit; };
  if (std::ranges::all_of(building.vertices,
                          [&](Vec3 p) { return fits(p.x) && fits(p.y) && fits(p.z); }))
    return;
  double reach = 0;
  for (const Vec3 p : building.vertices)
    for (const double c : {p.x, p.y, p.z})
      reach = std::max(reach, std::isfinite(c) ? std::abs(c) : Box::kInfinity);
  issues.push_back(error(building, Code::E501,
                         fmt::format("reaches {:.0f} m from its frame's origin, more than the "
                                     "{:.0f} m that weld_m = {} m allows",
                                     reach, limit, tolerances.weld_m)));
}

bool is_closed(const ShellMesh& mesh) {
  return std::ranges::count(mesh.twin, -1) == 0;  // in one go, as most have no open edge
}

Issue warning(const Building& building, Code code, std::string sentence) {
  return building_issue(Severity::warning, code, building.id, std::move(sentence));
}

/// "2 holes were closed by faces of oriel's own, 80.00 m² together, the largest 60.00 m²: 1 ground
/// (60.00 m²), 1 wall (20.00 m²)".
std::string closed_holes(std::span<const Cap> caps) {
  struct Sum {
    int count = 0;
    double area_m2 = 0;
  };
  std::map<CapKind, Sum> of_kind;
  double sum = 0, largest = 0;
  for (const Cap& cap : caps) {
    sum += cap.area_m2;
    largest = std::max(largest, cap.area_m2);
    ++of_kind[cap.kind].count;
    of_kind[cap.kind].area_m2 += cap.area_m2;
  }
  std::string text =
      caps.size() == 1
          ? fmt::format("1 hole was closed by a face of oriel's own, {:.2f} m²", sum)
          : fmt::format(
                "{} holes were closed by faces of oriel's own, {:.2f} m² together, the "
                "largest {:.2f} m²",
                caps.size(), sum, largest);
  of_kind.erase(CapKind::hole);
  const char* before = ": ";
  for (const auto& [kind, of] : of_kind) {
    text += fmt::format("{}{} ({:.2f} m²)", before, counted(of.count, to_string(kind)), of.area_m2);
    before = ", ";
  }
  return text;
}

/// What mending has done, as findings.
void tell_repairs(const Building& building, const RepairReport& report, bool is_open,
                  std::vector<Issue>& issues) {
  if (report.t_vertices > 0 || !report.duplicates.empty())
    issues.push_back(building_issue(
        Severity::note, Code::E317, building.id,
        fmt::format(
            "{} inserted into {}; {} dropped",
            counted(report.t_vertices, "vertex was", "vertices were"),
            agreeing(report.t_vertices, "the edge that it lies on", "the edges that they lie on"),
            counted(report.duplicates.size(), "duplicate polygon was",
                    "duplicate polygons were"))));
  if (is_open) return;
  if (report.turned > 0)
    issues.push_back(
        warning(building, Code::E308,
                fmt::format("{} turned round to agree with {} neighbours (val3dity 307)",
                            counted(report.turned, "polygon was", "polygons were"),
                            agreeing(report.turned, "its", "their"))));
  if (!report.caps.empty())
    issues.push_back(warning(building, Code::E316, closed_holes(report.caps)));
  if (!report.dangling.empty() || !report.inner.empty())
    issues.push_back(warning(
        building, Code::E315,
        fmt::format("{} left out: {} ({:.2f} m²), {} ({:.2f} m²)",
                    counted(report.dangling.size() + report.inner.size(),
                            "polygon does not bound the solid and was",
                            "polygons do not bound the solid and were"),
                    counted(report.dangling.size(), "dangling sheet"), report.dangling_area_m2,
                    counted(report.inner.size(), "inner face"), report.inner_area_m2)));
}

/// How many connected pieces the open edges make.
int count_loops(std::span<const OpenEdge> edges) {
  std::map<std::tuple<double, double, double>, int> number;
  DisjointSets sets(0);
  const auto number_of = [&](Vec3 p) {
    const auto [entry, is_new] =
        number.try_emplace({p.x, p.y, p.z}, static_cast<int>(number.size()));
    if (is_new) sets.add();
    return entry->second;
  };
  for (const OpenEdge& edge : edges) sets.unite(number_of(edge.from), number_of(edge.to));
  int loops = 0;
  for (int i = 0; i < std::ssize(number); ++i) loops += sets.find(i) == i;
  return loops;
}

/// The building stays open: how far, and the first few places.
Issue not_closed(const Building& building, std::span<const OpenEdge> edges) {
  std::string places;
  for (std::size_t i = 0; i < std::min<std::size_t>(edges.size(), 3); ++i) {
    const Vec3 p = edges[i].from;
    places += fmt::format("{}({:.3f}, {:.3f}, {:.3f})", i > 0 ? ", " : "", p.x, p.y, p.z);
  }
  return error(
      building, Code::E302,
      fmt::format("not closed: {} in {}, the first at {} (val3dity 302)",
                  counted(edges.size(), "open edge"), counted(count_loops(edges), "loop"), places));
}

/// The repair is none: it would lose what can be seen.
Issue not_enclosed(const Building& building, const detail::ExposedFaces& exposed) {
  return error(
      building, Code::E302,
      fmt::format("not closed: a repair would leave out {} ({:.2f} m², {:.0f} % "
                  "of the surface) that can be seen from outside (val3dity 302)",
                  counted(exposed.polygons, "polygon"), exposed.area, 100 * exposed.share));
}

/// A soup and its mesh: closed, or issues have an error.
struct MeshedSoup {
  Soup soup;
  ShellMesh mesh;
};

/// The options allow that a hole is closed so.
bool may_be_closed(const Cap& cap, const RepairOptions& repair) {
  if (repair.close == Closing::any || cap.area_m2 <= repair.cap_area_m2) return true;
  return repair.close == Closing::ground && cap.kind != CapKind::hole;
}

/// Where mending leaves the building open or closes holes: the shell of all polygons and of the
/// faces that are missing, if such may be as large. Mending knows single loops only: with those of
/// its windows it would close off what lies in a missing wall.
std::optional<detail::FilledShell> filled_instead(const detail::Mended& mended, const Soup& soup,
                                                  const Building& building,
                                                  const Tolerances& tolerances,
                                                  const RepairOptions& repair, Work& work) {
  const bool has_holes = mended.is_open || !mended.report.caps.empty();
  if (repair.close == Closing::none || !has_holes) return std::nullopt;
  auto filled = detail::fill_missing_faces(soup, building.id, tolerances, work);
  if (!filled || !std::ranges::all_of(filled->report.caps,
                                      [&](const Cap& cap) { return may_be_closed(cap, repair); }))
    return std::nullopt;
  return filled;
}

/// A wall that was small enough to be closed whatever it is counts as a hole: a window, say.
void name_holes(const RepairOptions& repair, RepairReport& report) {
  for (Cap& cap : report.caps)
    if (cap.kind == CapKind::wall && cap.area_m2 <= repair.cap_area_m2) cap.kind = CapKind::hole;
}

/// The shells of a building whose polygons are no closed shell as they came.
MeshedSoup mended_shells(const Building& building, const Tolerances& tolerances,
                         const RepairOptions& repair, std::vector<Issue> why, Solidified& out,
                         Work& work) {
  std::vector<Issue> told_before;
  const Soup soup = weld(building, tolerances, told_before);
  detail::Mended mended = detail::mend(soup, building.is_solid, tolerances, repair, work);
  if (auto filled = filled_instead(mended, soup, building, tolerances, repair, work)) {
    out.report = std::move(filled->report);
    name_holes(repair, out.report);
    out.issues.insert(out.issues.end(), filled->issues.begin(), filled->issues.end());
    tell_repairs(building, out.report, false, out.issues);
    return {std::move(filled->soup), std::move(filled->mesh)};
  }
  out.report = std::move(mended.report);
  name_holes(repair, out.report);
  tell_repairs(building, out.report, mended.is_open, out.issues);
  MeshedSoup shells;
  if (mended.is_open) {
    if (mended.exposed.polygons > 0) out.issues.push_back(not_enclosed(building, mended.exposed));
    // Without open edges it is not a hole that keeps it from being a solid.
    else if (!out.report.open_edges.empty())
      out.issues.push_back(not_closed(building, out.report.open_edges));
    else if (has_errors(why))
      out.issues.insert(out.issues.end(), why.begin(), why.end());
    else
      out.issues.push_back(error(building, Code::E302,
                                 "no open edges, but the same space is in front of most polygons "
                                 "and behind them: they enclose nothing (val3dity 302)"));
    return shells;
  }
  shells.soup = std::move(mended.soup);
  shells.mesh = detail::build_shell_mesh(shells.soup, building.id, out.issues);
  if (!has_errors(out.issues) && !is_closed(shells.mesh))
    out.issues.push_back(error(building, Code::E302, "not closed after mending (val3dity 302)"));
  return shells;
}

/// The boundary of the inside of closed surfaces; nothing if they are none, or if what is cut does
/// not close.
std::optional<MeshedSoup> uncrossed_shells(const Building& building, const Tolerances& tolerances,
                                           const Soup& soup, Solidified& out, Work& work) {
  auto uncrossed = detail::uncross(soup, tolerances, work);
  if (!uncrossed) return std::nullopt;
  // Which shell a piece is of is seen only now.
  for (SoupPolygon& polygon : uncrossed->soup.polygons) polygon.shell = -1;
  MeshedSoup whole{std::move(uncrossed->soup), {}};
  std::vector<Issue> issues;
  whole.mesh = detail::build_shell_mesh(whole.soup, building.id, issues);
  if (has_errors(issues) || !is_closed(whole.mesh)) return std::nullopt;
  out.report.was_needed = true;
  out.report.cut += uncrossed->cut;
  std::vector<int>& inner = out.report.inner;
  inner.insert(inner.end(), uncrossed->left_out.begin(), uncrossed->left_out.end());
  std::ranges::sort(inner);
  out.report.inner_area_m2 += uncrossed->left_out_m2;
  return whole;
}

MeshedSoup shells_of(const Building& building, const Tolerances& tolerances,
                     const RepairOptions& repair, Solidified& out, Work& work) {
  MeshedSoup shells{weld(building, tolerances, out.issues), {}};
  if (shells.soup.polygons.size() < 4) {
    out.issues.push_back(error(building, Code::E301,
                               fmt::format("{} cannot enclose a volume (val3dity 301)",
                                           counted(shells.soup.polygons.size(), "polygon"))));
    return shells;
  }
  std::vector<Issue> issues;
  shells.mesh = detail::build_shell_mesh(shells.soup, building.id, issues);
  if (has_errors(issues) || !is_closed(shells.mesh))
    return mended_shells(building, tolerances, repair, std::move(issues), out, work);
  out.issues.insert(out.issues.end(), issues.begin(), issues.end());
  return shells;
}

MeshedSoup closed_shells(const Building& building, const Tolerances& tolerances,
                         const RepairOptions& repair, Solidified& out, Work& work) {
  const bool cuts_closed = repair.crossings == Crossings::cut_closed;
  if (cuts_closed) {
    std::vector<Issue> issues;
    const Soup soup = weld(building, tolerances, issues);
    if (auto whole = uncrossed_shells(building, tolerances, soup, out, work)) {
      out.issues.insert(out.issues.end(), issues.begin(), issues.end());
      return std::move(*whole);
    }
  }
  MeshedSoup shells = shells_of(building, tolerances, repair, out, work);
  if (!cuts_closed || has_errors(out.issues)) return shells;
  auto whole = uncrossed_shells(building, tolerances, shells.soup, out, work);
  return whole ? std::move(*whole) : std::move(shells);
}

}  // namespace

Solidified solidify(const Building& building, const Tolerances& tolerances,
                    const RepairOptions& repair, std::int64_t budget) {
  Work work(budget);
  return solidify(building, tolerances, repair, work);
}

Solidified solidify(const Building& building, const Tolerances& tolerances,
                    const RepairOptions& repair, Work& work) {
  Solidified out;
  const auto is_set_aside = [&] { return has_errors(out.issues); };

  check_size(building, tolerances, out.issues);
  if (is_set_aside()) return out;
  const auto [soup, mesh] = closed_shells(building, tolerances, repair, out, work);
  if (!is_set_aside())
    detail::add_solid(building, soup, mesh, tolerances, out, work, repair.keeps_caps_apart);
  if (work.is_used_up())
    out.issues.push_back(used_up(building.id, work.budget(), "solidifying",
                                 "it is not repaired further, and planes may stay apart"));
  return out;
}

}  // namespace oriel
