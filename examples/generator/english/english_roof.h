#pragma once

#include "examples/generator/english/english_shell.h"
#include "examples/generator/english/english_window.h"

namespace oriel::generator {

/// Stacks and upstands on the party walls, dormers, roof windows and vent pipes of each dwelling.
/// For the main roof only: call it before additions add their planes.
void lay_out_english_roof(const EnglishSite& site, EnglishShell& shell);

/// Roof windows of a maker's size in a plane of the house's roof, in a row inside `room`.
void place_rooflights(const EnglishSite& site, House& house, std::size_t plane, const Rect& room,
                      int count);

}  // namespace oriel::generator
