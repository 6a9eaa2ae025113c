#include "cli/written_proof.h"

#include "kernel/io/as_written.h"
#include "kernel/model/detail/index.h"
#include "kernel/validate/part_folded.h"
#include "kernel/validate/validate.h"

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
    proof.fault = building_issue(Severity::error, "E318", building.id,
                                 fmt::format("the repaired solid is not valid: {} {}",
                                             findings[0].code, findings[0].sentence));
    return proof;
  }
}

namespace {

/// Facets are parted so often; what is folded then is judged as it is.
constexpr int kPartings = 4;

/// Parts facets that are folded as they are written; their parts are what they were. False if there
/// are none, or if something else is wrong, too.
bool part_once(const Document& document, const Building& building, LabelledBuilding& labelled) {
  if (!labelled.geometry) return false;
  const Building written =
      as_written(document, building, *labelled.geometry, spare_digits(document));
  auto parted = part_folded(*labelled.geometry, written, validate(written));
  if (!parted) return false;
  const std::size_t before = labelled.geometry->facets.size();
  labelled.geometry = std::move(parted->solid);
  for (std::size_t f = before; f < parted->whole_of.size(); ++f) {
    const int whole = parted->whole_of[f];
    if (!labelled.surface_of_polygon.empty())
      labelled.surface_of_polygon.push_back(labelled.surface_of_polygon[at(whole)]);
    for (Installation& installation : labelled.installations) {
      const auto found = std::ranges::find(installation.polygons, whole);
      if (found == installation.polygons.end()) continue;
      const int surface =
          installation.surfaces[at(static_cast<int>(found - installation.polygons.begin()))];
      installation.polygons.push_back(static_cast<int>(f));
      installation.surfaces.push_back(surface);
    }
  }
  return true;
}

bool can_be_valid(const Document& document, const Building& building, const Solid& own) {
  return validate(building).empty() || !prove_written(document, building, own).fault;
}

}  // namespace

Issue excuse_of(const Building& building, const std::string& why) {
  return building_issue(Severity::warning, "G413", building.id,
                        "is not valid as it is written, as it was not when it was read: " + why);
}

WrittenProof prove_redrawn(const Document& document, const Building& building, const Solid& own,
                           const Solid& solid) {
  WrittenProof proof = prove_written(document, building, solid);
  if (!proof.fault) return proof;
  std::string why = proof.fault->sentence;
  why.erase(0, why.find(": ") + 2);
  if (!can_be_valid(document, building, own)) return {0, {}, excuse_of(building, why)};
  proof.fault->code = "G410";
  proof.fault->sentence = "would not be valid as it is written: " + why;
  return proof;
}

void part_written(const Document& document, const Building& building, LabelledBuilding& labelled) {
  int partings = 0;
  while (partings < kPartings && part_once(document, building, labelled)) ++partings;
}

Judge judge_as_written(const Document& document, const Building& building, const Solid& own,
                       bool is_thorough) {
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
