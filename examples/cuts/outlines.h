#pragma once

#include "examples/cuts/view.h"

#include <utility>
#include <vector>

namespace oriel::cuts {

/// A corner between samples, counted from the top left.
using Corner = std::pair<int, int>;
/// A closed line of corners; the first is not repeated.
using Outline = std::vector<Corner>;

/// The outlines of every label, by label (0, nothing, has none): all its outer lines and holes, to
/// be filled even-odd. Steps of the samples are smoothed by up to `tolerance` samples (Douglas and
/// Peucker), between the same corners on both sides of a line, so neighbours leave no gap.
std::vector<std::vector<Outline>> outlines(const Image& image, double tolerance);

}  // namespace oriel::cuts
