#pragma once

#include "examples/generator/english/english_window.h"
#include "examples/generator/house/house.h"

namespace oriel::generator {

/// All four walls of a block of flats: on the street two bays, loggias or balconies, and the
/// entrance with the windows of the stairs above it; loggias or balconies of the kitchens on the
/// garden side.
void lay_out_flats(const EnglishSite& site, House& house);

}  // namespace oriel::generator
