#include "oriel/repair.h"

#include "generalise/generalise.h"
#include "model/version.h"
#include "oriel/drawing/output_check.h"
#include "oriel/drawing/repaired.h"
#include "oriel/drawing/targets.h"
#include "oriel/pipeline/pipeline.h"
#include "oriel/segment.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// Facets that oriel made close what the data leave open: a ClosureSurface where the building has
/// semantics.
void label_caps(const Building& building, LabelledBuilding& repaired) {
  if (std::ranges::all_of(building.polygons, [](const Polygon& p) { return p.hint.empty(); }))
    return;
  for (const Facet& facet : repaired.geometry->facets) {
    repaired.surface_of_polygon.push_back(facet.polygons.empty() ? 0 : -1);
    if (facet.polygons.empty() && repaired.surfaces.empty())
      repaired.surfaces.push_back({"ClosureSurface", -1, {}});
  }
}

/// The building with its solid in the place of its polygons, and counts of what was repaired.
LabelledBuilding output_of(const Building& building, const Repaired& repaired,
                           bool keeps_semantics) {
  LabelledBuilding output;
  output.building = building.id;
  output.geometry = repaired.solid;
  output.keeps_semantics = keeps_semantics;
  if (keeps_semantics) label_caps(building, output);
  const auto add_count = [&](const char* name, std::size_t count) {
    if (count > 0) output.attributes.emplace_back(name, static_cast<std::int64_t>(count));
  };
  output.attributes.emplace_back("oriel_version", std::string(kVersion));
  add_count("oriel_repair_duplicates", repaired.report.duplicates.size());
  add_count("oriel_repair_dangling", repaired.report.dangling.size());
  add_count("oriel_repair_inner", repaired.report.inner.size());
  add_count("oriel_repair_caps", repaired.report.caps.size());
  return output;
}

/// Makes the solid one that is valid as it is written: as it is, mended, or redrawn. Why it could
/// not be done.
std::optional<Issue> make_valid(OutputCheck& check, const PipelineOptions& options, Repaired& out,
                                Work& work) {
  if (auto made = check.made_valid(*out.solid)) {
    out.solid = std::move(made);
    return std::nullopt;
  }
  auto fault = check.fault(*out.solid);
  if (options.repair.crossings != Crossings::cut) return fault;
  auto again = repaired_solid(check, options.tolerances, options, work);
  if (!again) return fault;
  out.solid = again->mended ? std::move(again->mended) : std::move(again->made.solid);
  out.report = std::move(again->made.repair);
  return std::nullopt;
}

Repaired checked_solid(const Document& document, const Building& building, PipelineResult solid,
                       const PipelineOptions& options) {
  Repaired out{std::move(solid.solid), std::move(solid.repair), {}, std::move(solid.issues)};
  std::ranges::move(invalid_rest(document, building, false), std::back_inserter(out.issues));
  if (!out.solid) return out;
  Work work(options.budget);
  OutputCheck check(document, building);
  auto fault = make_valid(check, options, out, work);
  if (fault && work.is_used_up())
    out.issues.push_back(used_up(building.id, work.budget(), "repairing",
                                 "not all ways to make it valid were tried"));
  if (fault) {
    out.solid.reset();
    out.issues.push_back(std::move(*fault));
    return out;
  }
  out.output = output_of(building, out, !options.ignores_semantics);
  return out;
}

}  // namespace

PipelineOptions repair_defaults() {
  PipelineOptions options;
  options.repair.crossings = Crossings::cut;
  options.repair.keeps_caps_apart = true;
  return options;
}

Repaired repair(const Document& document, const Building& building,
                const PipelineOptions& options) {
  if (!building.installations.empty())
    return repair(document, without_installations(building), options);
  return repair(document, building, solid_of(building, options), options);
}

Repaired repair(const Document& document, const Building& building, PipelineResult solid,
                const PipelineOptions& options) {
  return logged(
      "repaired", building,
      [&] { return checked_solid(document, building, std::move(solid), options); },
      [](const Repaired& made) {
        return fmt::format("facets={} was_needed={} issues={}",
                           made.solid ? made.solid->facets.size() : 0, made.report.was_needed,
                           made.issues.size());
      });
}

Checked<LabelledBuilding> on_solid(const Document& document, const Building& building,
                                   const PipelineResult& result, const LabelledBuilding& labelled) {
  if (result.is_open())
    return {{},
            {building_issue(Severity::error, Code::G404, building.id,
                            "is open: its polygons are labelled unchanged")}};
  Generalised whole{*result.solid, {}};
  whole.is_drawn_anew = true;
  whole.closing = closing_faces(whole.solid);
  LabelledBuilding drawn =
      redraw(redraw_context(building, result, labelled), std::move(whole)).labelled;
  if (const auto fault = OutputCheck(document, building).fault(*drawn.geometry))
    return {{}, {*fault}};
  return {std::move(drawn), {}};
}

}  // namespace oriel
