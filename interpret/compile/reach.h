#pragma once

#include "interpret/language/findings.h"
#include "interpret/pack/pack.h"

namespace oriel::rules {

/// Warns of rules that can never hold at the params' values (R254), of rules and entries of
/// `generalise:` before which another one always comes (R255), and of entries that overlap with
/// another operation (R256). What cannot be proved from the pack alone is not reported, nor what
/// stands in a pack beneath. `pack.steps` must be known.
void check_reach(const Pack& pack, Findings& findings);

/// The part of check_reach about entries, which needs no steps.
void check_entries(const Pack& pack, Findings& findings);

}  // namespace oriel::rules
