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
        std::exchange(installation, Installation{installation.id, installation.label, {}, {}});
    for (std::size_t f = 0; f < parted.whole_of.size(); ++f) {
      const auto found = std::ranges::find(old.polygons, parted.whole_of[f]);
      if (found == old.polygons.end()) continue;
      installation.polygons.push_back(static_cast<int>(f));
      installation.surfaces.push_back(
          old.surfaces[static_cast<std::size_t>(found - old.polygons.begin())]);
    }
  }
}

/// All that findings depend on is the same.
bool have_one_shape(const Solid& p, const Solid& q) {
  const auto are_alike = [](const Shell& one, const Shell& other) {
    return one.facets == other.facets && one.lump == other.lump && one.is_cavity == other.is_cavity;
  };
  return std::ranges::equal(p.vertices, q.vertices, {}, &Vertex::point, &Vertex::point) &&
         std::ranges::equal(p.facets, q.facets, {}, &Facet::loops, &Facet::loops) &&
         std::ranges::equal(p.shells, q.shells, are_alike);
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

const std::vector<Finding>& OutputCheck::findings_as_read() {
  if (!as_read_) as_read_ = validate(building_);
  return *as_read_;
}

const std::vector<Finding>& OutputCheck::findings(const Solid& solid) {
  const auto known = std::ranges::find_if(
      judged_, [&](const Judged& one) { return have_one_shape(one.solid, solid); });
  if (known != judged_.end()) return known->findings;
  ValidateOptions options;
  options.judge = ValidateOptions::Judge::any;
  return judged_.emplace_back(solid, validate(as_written(document_, building_, solid), options))
      .findings;
}

std::optional<Issue> OutputCheck::fault(const Solid& solid) {
  const auto& found = findings(solid);
  if (found.empty()) return {};
  return {building_issue(Severity::error, Code::E318, building_.id,
                         fmt::format("the repaired solid is not valid: {} {}",
                                     to_string(found[0].code), found[0].sentence))};
}

std::optional<Issue> OutputCheck::fault_of_redrawn(const Solid& own, bool is_parted,
                                                   const Solid& solid) {
  const auto& found = findings(solid);
  if (found.empty()) return {};
  const std::string why = fmt::format("{} {}", to_string(found[0].code), found[0].sentence);
  if (!is_parted && !can_be_valid(own)) return {invalid_before(building_, why)};
  return {building_issue(Severity::error, Code::G410, building_.id,
                         "would not be valid as written: " + why)};
}

bool OutputCheck::can_be_valid(const Solid& own) {
  return findings_as_read().empty() || findings(own).empty();
}

/// Welds what is written as one point, else parts facets that are folded as they are written.
/// Nothing if there is neither, or if something else is wrong, too.
std::optional<PartedSolid> OutputCheck::parted_once(const Solid& solid) {
  const auto& found = findings(solid);
  if (found.empty()) return std::nullopt;
  const Building written = as_written(document_, building_, solid);
  auto welded = weld_written(solid, written, found);
  return welded ? std::move(welded) : part_folded(solid, written, found);
}

std::optional<Solid> OutputCheck::made_valid(Solid solid) {
  for (int i = 0; i < kPartings; ++i) {
    auto parted = parted_once(solid);
    if (!parted) break;
    solid = std::move(parted->solid);
  }
  if (!findings(solid).empty()) return std::nullopt;
  return solid;
}

void OutputCheck::part(LabelledBuilding& labelled) {
  for (int i = 0; i < kPartings && labelled.geometry; ++i) {
    auto parted = parted_once(*labelled.geometry);
    if (!parted) return;
    put_parted(std::move(*parted), labelled);
  }
}

Fitness WrittenJudge::fitness_of(const Solid& solid) {
  if (is_given_up()) work_ = Work(-1);
  work_.add(kStepsPerJudging * corners_of(solid));
  if (work_.is_used_up()) return Fitness::unfit;
  if (is_parted_ ? check_.made_valid(solid).has_value() : check_.findings(solid).empty())
    return Fitness::valid;
  return is_parted_ || check_.can_be_valid(own_) ? Fitness::unfit : Fitness::as_it_came;
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
