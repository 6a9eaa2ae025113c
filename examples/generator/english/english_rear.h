#pragma once

#include "examples/generator/english/english_window.h"
#include "examples/generator/house/house.h"

namespace oriel::generator {

/// Garden side of a terrace, a pair or a town row: back additions and lean-to extensions with their
/// windows and doors, then the openings of the back wall. Adds roof planes to the house.
void lay_out_english_rear(const EnglishSite& site, House& house);

/// The walls at both ends of the row, with the garages of a pair.
void lay_out_english_ends(const EnglishSite& site, House& house);

}  // namespace oriel::generator
