#include "oriel/drawing/repaired.h"

#include "kernel/base/text/counted.h"
#include "oriel/pipeline/pipeline.h"

#include <array>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// Tolerances with which what crosses is cut, as multiples of those given. Planes that are finer
/// keep surfaces apart that come near each other, coarser ones make one of them: at the defaults up
/// to 10 mm, as where they are fitted to noise.
struct Times {
  double plane_offset, weld;
};
constexpr std::array<Times, 4> kTimes{{{1, 1}, {0.5, 1}, {2.5, 2.5}, {5, 5}}};

/// Nothing if the solid is not valid as it is written, mended or not.
std::optional<RepairedSolid> valid_one(OutputCheck& check, PipelineResult made) {
  if (check.findings(*made.solid).empty()) return RepairedSolid{std::move(made)};
  auto mended = check.made_valid(*made.solid);
  if (!mended) return std::nullopt;
  return RepairedSolid{std::move(made), std::move(mended)};
}

}  // namespace

Issue redrawn_from_inside(OutputCheck& check, const RepairReport& report) {
  const auto& findings = check.findings_as_read();
  const std::string why = findings.empty()
                              ? "its surface"
                              : fmt::format("was not valid in the input ({} {}) and",
                                            to_string(findings[0].code), findings[0].sentence);
  return building_issue(Severity::warning, Code::G417, check.building().id,
                        fmt::format("{} would not be valid as written: it is redrawn from the "
                                    "boundary of its interior, with {} cut",
                                    why, counted(report.cut, "polygon")));
}

std::optional<RepairedSolid> cut_solid(OutputCheck& check, const Tolerances& tolerances,
                                       const PipelineOptions& options, Work& work) {
  RepairOptions cutting = options.repair;
  cutting.crossings = Crossings::cut;
  PipelineResult cut = run_to_solid(check.building(), tolerances, cutting, work, options.observer);
  if (!cut.solid || work.is_used_up()) return std::nullopt;
  cut.tolerances = tolerances;
  if (auto valid = valid_one(check, std::move(cut))) return valid;
  return repaired_solid(check, tolerances, options, work);
}

Issue repaired_first(const Building& building, const RepairReport& report) {
  double closed_m2 = 0;
  for (const Cap& cap : report.caps) closed_m2 += cap.area_m2;
  return building_issue(
      Severity::warning, Code::G420, building.id,
      fmt::format("is open in the input and is repaired first, with {} cut, {} left out and {} "
                  "closed ({:.2f} m²)",
                  counted(report.cut, "polygon"), report.dangling.size() + report.inner.size(),
                  counted(report.caps.size(), "hole"), closed_m2));
}

std::optional<RepairedSolid> repaired_solid(OutputCheck& check, const Tolerances& tolerances,
                                            const PipelineOptions& options, Work& work) {
  RepairOptions repair = options.repair;
  repair.crossings = Crossings::cut_closed;
  for (const Times& times : kTimes) {
    Tolerances tried = tolerances;
    tried.plane_offset_m *= times.plane_offset;
    tried.weld_m *= times.weld;
    PipelineResult made = run_to_solid(check.building(), tried, repair, work, options.observer);
    if (work.is_used_up()) return std::nullopt;
    made.tolerances = tried;
    if (!made.solid) continue;
    if (auto valid = valid_one(check, std::move(made))) return valid;
  }
  return std::nullopt;
}

Issue stays_open(const Building& building) {
  if (has_only_outline(building))
    return building_issue(Severity::error, Code::E205, building.id,
                          fmt::format("has no walls and roof at lod {}: there is no solid to "
                                      "redraw; expected lod 1 or higher",
                                      building.lod));
  return building_issue(Severity::error, Code::G404, building.id,
                        "is open and cannot be repaired: there is no solid to redraw");
}

bool is_intricate(const Solid& repaired) { return repaired.facets.size() > 1000; }

}  // namespace oriel
