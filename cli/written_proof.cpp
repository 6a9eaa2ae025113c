#include "cli/written_proof.h"

#include "kernel/io/as_written.h"
#include "kernel/validate/validate.h"

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

}  // namespace oriel::cli
