#include "cli/written_proof.h"

#include "kernel/io/as_written.h"
#include "kernel/validate/validate.h"

#include <string>
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
