#include "oriel/drawing/output_check.h"

#include "io/cityjson/cityjson_source.h"
#include "io/levels/written_grid.h"
#include "kernel/base/index.h"
#include "kernel/validate/part_folded.h"
#include "kernel/validate/weld_written.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel {

namespace {

std::vector<Finding> findings_for_any(const Building& written) {
  ValidateOptions options;
  options.judge = ValidateOptions::Judge::any;
  return validate(written, options);
}

}  // namespace

std::vector<Finding> findings_as_written(const Document& document, const Building& building,
                                         const Solid& solid) {
  return findings_for_any(as_written(document, building, solid));
}

std::optional<Issue> check_output(const Document& document, const Building& building,
                                  const Solid& solid) {
  const auto findings = findings_as_written(document, building, solid);
  if (findings.empty()) return {};
  return {building_issue(Severity::error, Code::E318, building.id,
                         fmt::format("the repaired solid is not valid: {} {}",
                                     to_string(findings[0].code), findings[0].sentence))};
}

namespace {

/// What judging a solid as it is written takes, for each of its corners.
constexpr std::int64_t kStepsPerJudging = 128;

/// Facets are welded and parted so often; what is wrong then is judged as it is.
constexpr int kPartings = 4;

/// Surfaces and installations are handed on to the facets that are left of theirs.
void put_parted(PartedSolid parted, LabelledBuilding& labelled) {
  labelled.geometry = std::move(parted.solid);
  if (!labelled.surface_of_polygon.empty()) {
    std::vector<int> surfaces;
    for (const int whole : parted.whole_of)
      surfaces.push_back(labelled.surface_of_polygon[at(whole)]);
    labelled.surface_of_polygon = std::move(surfaces);
  }
  for (Installation& installation : labelled.installations) {
    const Installation old =
        std::exchange(installation, Installation{installation.id, installation.attributes, {}, {}});
    for (std::size_t f = 0; f < parted.whole_of.size(); ++f) {
      const auto found = std::ranges::find(old.polygons, parted.whole_of[f]);
      if (found == old.polygons.end()) continue;
      installation.polygons.push_back(static_cast<int>(f));
      installation.surfaces.push_back(
          old.surfaces[static_cast<std::size_t>(found - old.polygons.begin())]);
    }
  }
}

/// Welds what is written as one point, else parts facets that are folded as they are written.
/// Nothing if there is neither, or if something else is wrong, too.
std::optional<PartedSolid> parted_once(const Document& document, const Building& building,
                                       const Solid& solid) {
  const Building written = as_written(document, building, solid);
  const auto findings = findings_for_any(written);
  auto welded = weld_written(solid, written, findings);
  return welded ? std::move(welded) : part_folded(solid, written, findings);
}

bool can_be_valid(const Document& document, const Building& building, const Solid& own) {
  return validate(building).empty() || !check_output(document, building, own);
}

}  // namespace

std::vector<Issue> invalid_rest(const Document& document, const Building& building,
                                bool is_redrawn) {
  std::vector<Issue> issues;
  if (!document.source) return issues;
  for (auto [at, end] = document.source->beside.equal_range(building.id); at != end; ++at) {
    const Building& rest = at->second;
    const bool is_installation = rest.id != building.id;
    if (is_redrawn && !is_installation) continue;
    const auto findings = validate(rest);
    if (findings.empty()) continue;
    issues.push_back(
        building_issue(Severity::error, Code::E321, building.id,
                       fmt::format("its {} stays unchanged and is not valid: {} {}",
                                   is_installation ? fmt::format("installation '{}'", rest.id)
                                                   : "other geometry of lod " + rest.lod,
                                   to_string(findings[0].code), findings[0].sentence)));
  }
  return issues;
}

Issue invalid_before(const Building& building, const std::string& why) {
  return building_issue(Severity::error, Code::G413, building.id,
                        "is not valid as written, and was not valid in the input: " + why);
}

std::optional<Issue> check_redrawn(const Document& document, const Building& building,
                                   const Solid& own, bool is_parted, const Solid& solid) {
  auto fault = check_output(document, building, solid);
  if (!fault) return fault;
  std::string why = fault->sentence;
  why.erase(0, why.find(": ") + 2);
  if (!is_parted && !can_be_valid(document, building, own)) return {invalid_before(building, why)};
  fault->code = Code::G410;
  fault->sentence = "would not be valid as written: " + why;
  return fault;
}

std::optional<Solid> made_valid(const Document& document, const Building& building,
                                const Solid& solid) {
  if (!check_output(document, building, solid)) return solid;
  Solid mended = solid;
  for (int i = 0; i < kPartings; ++i) {
    auto parted = parted_once(document, building, mended);
    if (!parted) break;
    mended = std::move(parted->solid);
  }
  if (check_output(document, building, mended)) return std::nullopt;
  return mended;
}

void part_written(const Document& document, const Building& building, LabelledBuilding& labelled) {
  for (int i = 0; i < kPartings && labelled.geometry; ++i) {
    auto parted = parted_once(document, building, *labelled.geometry);
    if (!parted) return;
    put_parted(std::move(*parted), labelled);
  }
}

Fitness WrittenJudge::fitness_of(const Solid& solid) {
  if (is_given_up_ && is_given_up_()) work_ = Work(-1);
  work_.add(kStepsPerJudging * corners_of(solid));
  if (work_.is_used_up()) return Fitness::unfit;
  if (is_parted_ ? made_valid(document_, building_, solid).has_value()
                 : !check_output(document_, building_, solid))
    return Fitness::valid;
  if (!can_be_valid_) can_be_valid_ = is_parted_ || can_be_valid(document_, building_, own_);
  return *can_be_valid_ ? Fitness::unfit : Fitness::as_it_came;
}

Work drawing_work(std::int64_t budget) {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() / 2;
  return Work(std::min(budget, most) + std::min(budget, most) / 2);
}

Issue not_all_drawn(const Building& building, std::int64_t budget) {
  return used_up(building.id, budget, "generalising",
                 "what was not carried out by then stays unchanged");
}

}  // namespace oriel
