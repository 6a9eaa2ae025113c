#include "cli/pipeline/mended_line.h"

#include "cli/pipeline/line_surfaces.h"
#include "cli/pipeline/written_proof.h"
#include "kernel/io/levels/as_written.h"
#include "kernel/validate/part_folded.h"
#include "kernel/validate/validate.h"

#include <array>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// Tolerances with which what crosses is cut, as multiples of those given. Planes that are finer
/// keep surfaces apart that come near each other, coarser ones make one of them: at the defaults up
/// to 10 mm, as where they are fitted to noise.
struct Times {
  double plane_offset, weld;
};
constexpr std::array<Times, 4> kTimes{{{1, 1}, {0.5, 1}, {2.5, 2.5}, {5, 5}}};

/// Facets are parted so often; what is folded then is given up.
constexpr int kSolidPartings = 4;

Building hintless(Building building) {
  for (Polygon& polygon : building.polygons) polygon.hint.clear();
  return building;
}

/// True if the solid is valid as it is written, once its folded facets are parted.
bool make_valid(const Document& document, const Building& building, MendedSolid& mended) {
  for (int i = 0; i < kSolidPartings; ++i) {
    const WrittenProof proof = prove_written(document, building, *mended.line.solid);
    mended.digits = proof.digits;
    if (!proof.fault) return true;
    const Building written = as_written(document, building, *mended.line.solid, proof.digits);
    auto parted = part_folded(*mended.line.solid, written, validate(written));
    if (!parted) return false;
    mended.line.solid = std::move(parted->solid);
  }
  return !prove_written(document, building, *mended.line.solid).fault;
}

Issue mended_warning(const Building& building, const OnLine& line) {
  const auto findings = validate(building);
  const std::string why = findings.empty()
                              ? "its surface"
                              : fmt::format("was not valid as it was read ({} {}) and",
                                            to_string(findings[0].code), findings[0].sentence);
  return building_issue(
      Severity::warning, Code::G417, building.id,
      fmt::format("{} would not be valid as it is written: it is redrawn from the boundary of its "
                  "inside, with {} polygons cut",
                  why, line.repair.cut));
}

}  // namespace

OnLine run_whole_line(const LineArguments& arguments, const RuleBase* rules,
                      const Building& building, const Tolerances& tolerances, Timings& timings) {
  return whole_line_from(run_to_solid(building, tolerances, arguments.repair_options(), timings),
                         arguments, rules, building, tolerances, timings);
}

OnLine whole_line_from(OnLine solid, const LineArguments& arguments, const RuleBase* rules,
                       const Building& building, const Tolerances& tolerances, Timings& timings) {
  const SegmentOptions options = arguments.segment_options(tolerances);
  DescribeOptions describing;
  if (rules != nullptr && arguments.only_labels_features)
    describing = {rules->attributes_read(), rules->relations_read()};
  OnLine line = arguments.ignores_semantics ? run_from_solid(std::move(solid), hintless(building),
                                                             options, rules, timings, describing)
                                            : run_from_solid(std::move(solid), building, options,
                                                             rules, timings, describing);
  line.tolerances = tolerances;
  if (rules != nullptr && arguments.only_names_surfaces)
    name_line_surfaces(building, tolerances, *rules, timings, line);
  else if (rules != nullptr)
    describe_line_surfaces(building, tolerances, timings, line);
  return line;
}

std::optional<MendedSolid> mended_solid(const LineArguments& arguments, const Document& document,
                                        const Building& building, const Tolerances& tolerances,
                                        Timings& timings) {
  RepairOptions repair = arguments.repair_options();
  repair.crossings = Crossings::cut_closed;
  for (const Times& times : kTimes) {
    Tolerances tried = tolerances;
    tried.plane_offset_m *= times.plane_offset;
    tried.weld_m *= times.weld;
    MendedSolid mended{run_to_solid(building, tried, repair, timings), 0};
    mended.line.tolerances = tried;
    if (mended.line.solid && make_valid(document, building, mended)) return mended;
  }
  return std::nullopt;
}

std::optional<OnLine> mended_line(const LineArguments& arguments, const RuleBase* rules,
                                  const Document& document, const Building& building,
                                  const OnLine& line, Timings& timings) {
  auto mended = mended_solid(arguments, document, building, line.tolerances, timings);
  if (!mended) return std::nullopt;
  const Tolerances tolerances = mended->line.tolerances;
  OnLine whole =
      whole_line_from(std::move(mended->line), arguments, rules, building, tolerances, timings);
  if (!whole.is_done() || whole.is_open) return std::nullopt;
  whole.issues.push_back(mended_warning(building, whole));
  return whole;
}

}  // namespace oriel::cli
