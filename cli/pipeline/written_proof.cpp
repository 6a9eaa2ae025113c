#include "cli/pipeline/written_proof.h"

#include "kernel/base/index.h"
#include "kernel/io/levels/as_written.h"
#include "kernel/validate/part_folded.h"
#include "kernel/validate/validate.h"
#include "kernel/validate/weld_written.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::cli {

WrittenProof prove_written(const Document& document, const Building& building, const Solid& solid) {
  WrittenProof proof;
  const int spare = spare_digits(document);
  for (;; ++proof.digits) {
    const auto findings = validate(as_written(document, building, solid, proof.digits));
    if (findings.empty()) return proof;
    if (proof.digits < spare) continue;
    proof.fault = building_issue(Severity::error, Code::E318, building.id,
                                 fmt::format("the repaired solid is not valid: {} {}",
                                             to_string(findings[0].code), findings[0].sentence));
    return proof;
  }
}

namespace {

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

/// Welds what is written as one point, else parts facets that are folded as they are written. False
/// if there is neither, or if something else is wrong, too.
bool part_once(const Document& document, const Building& building, LabelledBuilding& labelled) {
  if (!labelled.geometry) return false;
  const Building written =
      as_written(document, building, *labelled.geometry, spare_digits(document));
  const auto findings = validate(written);
  auto parted = weld_written(*labelled.geometry, written, findings);
  if (!parted) parted = part_folded(*labelled.geometry, written, findings);
  if (!parted) return false;
  put_parted(std::move(*parted), labelled);
  return true;
}

bool can_be_valid(const Document& document, const Building& building, const Solid& own) {
  return validate(building).empty() || !prove_written(document, building, own).fault;
}

}  // namespace

Issue excuse_of(const Building& building, const std::string& why) {
  return building_issue(Severity::warning, Code::G413, building.id,
                        "is not valid as it is written, as it was not when it was read: " + why);
}

WrittenProof prove_redrawn(const Document& document, const Building& building, const Solid& own,
                           const Solid& solid) {
  WrittenProof proof = prove_written(document, building, solid);
  if (!proof.fault) return proof;
  std::string why = proof.fault->sentence;
  why.erase(0, why.find(": ") + 2);
  if (!can_be_valid(document, building, own)) return {0, {}, excuse_of(building, why)};
  proof.fault->code = Code::G410;
  proof.fault->sentence = "would not be valid as it is written: " + why;
  return proof;
}

void part_written(const Document& document, const Building& building, LabelledBuilding& labelled) {
  int partings = 0;
  while (partings < kPartings && part_once(document, building, labelled)) ++partings;
}

SolidValidator judge_as_written(const Document& document, const Building& building,
                                const Solid& own, bool is_thorough) {
  std::optional<bool> may_be;
  return {[&document, &building, &own, may_be](const Solid& solid) mutable {
            if (!prove_written(document, building, solid).fault) return Fitness::valid;
            if (!may_be) may_be = can_be_valid(document, building, own);
            return *may_be ? Fitness::unfit : Fitness::as_it_came;
          },
          {},
          is_thorough};
}

}  // namespace oriel::cli
