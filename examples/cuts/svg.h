#pragma once

#include "model/segmentation.h"

#include <string>

namespace oriel::cuts {

/// The building cut step by step as an SVG picture: a panel a step (steps_of), each seen from the
/// corner that shows most of what is cut, parts in colour, and the kind of the cut, v and the
/// planes below.
std::string draw_cuts(const Segmentation& segmentation);

}  // namespace oriel::cuts
