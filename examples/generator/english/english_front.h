#pragma once

#include "examples/generator/english/english_window.h"
#include "examples/generator/house/house.h"

namespace oriel::generator {

/// One dwelling's share of a wall along x, and on which side its front door is.
struct Dwelling {
  Um x0 = 0, x1 = 0;
  bool has_door_on_right = false;
};

/// Doors of neighbours stand side by side, two and two.
Dwelling dwelling_of(const EnglishPlan& plan, int index);

/// A bay as the plan has it, its eaves at `eaves` and its roof at most at `highest`, with windows
/// on each of its storeys. Returns the height at which its roof ends on the wall; 0 if there was no
/// room.
Um place_bay_window(const EnglishSite& site, Panel& panel, const Rect& zone, Um eaves, Um highest);

/// A balcony before the band, on the floor at band.v0.
void place_english_balcony(const EnglishSite& site, Panel& panel, const Rect& band, Um parapet);

/// Street front of a terrace, a pair or a town row.
void lay_out_english_front(const EnglishSite& site, House& house);

}  // namespace oriel::generator
