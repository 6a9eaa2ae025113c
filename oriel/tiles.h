#pragma once

#include "io/cityjson/material_colours.h"
#include "io/document.h"
#include "io/tiles/tile_building.h"
#include "io/tiles/tileset_writer.h"
#include "oriel/series.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// A building at all scales of a tileset (write_tileset). `made` is its series for `scales`,
/// perhaps with SeriesOptions::has_only_levels: a level is the solid that at() gives, and the
/// distance between two levels is no further off than 5 mm (level_distance_m). Without levels it
/// looks at all scales as it was read; without faces there is nothing. Faces have `colours`, of
/// material_colours().
std::optional<TileBuilding> tile_building(const Building& building, const Series& made,
                                          const std::vector<double>& scales,
                                          const FaceColours& colours = {});

/// So many scales from the first to the last in equal ratios, rounded to three digits, each once:
/// what lies between has fewer buildings that change at the same time. `levels` is at least 2,
/// `last` greater than `first`.
std::vector<double> scales_between(double first, double last, int levels);

}  // namespace oriel
