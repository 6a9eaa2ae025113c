#pragma once

#include "interpret/language/findings.h"
#include "interpret/pack/pack.h"

#include <string>
#include <string_view>

namespace oriel::rules {

/// True if features with this label are written with a type: the class or one above it has `emit:`.
bool is_label_emitted(const Pack& pack, std::string_view label);

/// What annotate() makes of features of other classes.
inline constexpr std::string_view kGenericForms =
    "a protrusion as a generic BuildingInstallation, anything else by the label of its surfaces";

/// "the class has no 'emit'; add emit: {chimney: {type: BuildingInstallation}}".
std::string advice_to_emit(std::string_view label);

/// Labels that the pack gives and does not emit (R258, a note): a pack may be of use without
/// writing. Labels and rules of a pack beneath are no finding of this one. After the emissions of
/// classes called window and door were added.
void check_emitted(const Pack& pack, Findings& findings);

}  // namespace oriel::rules
