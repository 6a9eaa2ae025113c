#pragma once

#include "kernel/validate/defects.h"
#include "kernel/validate/solids/shell_checks.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// The shells of a solid, all good, the exterior one first.
struct JudgedSolid {
  int body = 0;
  std::vector<const JudgedShell*> shells;
};

/// Judges how the shells of a solid are turned (val3dity 405), then how they lie to each other
/// (401, 402, 403), then whether the interior is in one piece (404).
bool judge(const SnappedBuilding& building, const JudgedSolid& solid, FindingList& findings);

/// Judges the solids of a CompositeSolid, all good: none twice (502), interiors apart (501), all
/// joined by faces (503); the first of these that fails ends it.
bool judge_composite(const SnappedBuilding& building, std::span<const JudgedSolid> solids,
                     FindingList& findings);

}  // namespace oriel::detail
