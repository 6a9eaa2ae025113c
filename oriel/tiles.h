#pragma once

#include "io/document.h"
#include "io/tiles/tile_building.h"
#include "io/tiles/tileset_writer.h"
#include "oriel/series.h"

#include <string>
#include <vector>

namespace oriel {

/// The buildings of a record at all scales of a tileset (write_tileset), in their order. `made` is
/// what series() made of the document and `results` for `scales`, perhaps with
/// SeriesOptions::has_only_levels: a level is the solid that at() gives, and the distance between
/// two levels is no further off than 5 mm (level_distance_m). A building without levels looks at
/// all scales as it was read; one without faces is left out, and so is one that is_passed_over.
/// With `has_colours` faces have the colours of the input's materials (material_colours).
std::vector<TileBuilding> tile_buildings(const Document& document,
                                         const std::vector<PipelineResult>& results,
                                         const Series& made, const std::vector<double>& scales,
                                         bool has_colours = false);

/// So many scales from the first to the last in equal ratios, rounded to three digits, each once:
/// what lies between has fewer buildings that change at the same time. `levels` is at least 2,
/// `last` greater than `first`.
std::vector<double> scales_between(double first, double last, int levels);

}  // namespace oriel
