#pragma once

#include "examples/generator/english/english_window.h"

namespace oriel::generator {

/// A door leaf of the row's size in the panel, standing at `v0` around `middle`, with the row's
/// fanlight over it if `has_fanlight`: one opening, its frame and glass belong to the door. Returns
/// its rectangle.
Rect add_english_door(const EnglishSite& site, Panel& panel, Um middle, Um v0, bool has_fanlight);

/// The front door around `middle` with what belongs to it: steps up to the ground floor, a porch
/// behind the wall, a hood, pilasters. No porch or hood reaches above `ceiling`, but for a gabled
/// hood, by half a metre. Returns the rectangle of the wall that all this takes, entrance_width
/// wide.
Rect place_entrance(const EnglishSite& site, Panel& panel, Um middle, Um ceiling);

Um entrance_width(const EnglishPlan& plan);

/// A door of one or two leaves without a frame: of a garage, or onto a balcony.
void add_plain_door(const EnglishSite& site, Panel& panel, const Rect& rect,
                    std::string_view subclass);

}  // namespace oriel::generator
