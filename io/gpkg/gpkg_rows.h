#pragma once

#include "io/document.h"
#include "io/records/feature_records.h"

#include <span>
#include <string>
#include <string_view>

namespace oriel {

/// What a record adds to a GeoPackage, as bytes for GpkgWriter::take(). `text` is what
/// write_cityjson() made of `document`, with its labels; `features` are the records of its
/// features, whose attributes are written with them. Depends on nothing else, so several threads
/// may call it.
///
/// - `buildings`: each Building and BuildingPart with its attributes, its geometry (of several
/// levels
///   the one that oriel has named surfaces of, else the highest), and how many features of each
///   label it has.
/// - `surfaces`: each semantic surface of these geometries.
/// - `features`: each feature that a surface or an installation of theirs is named after
///   (`oriel_id`), with all its polygons, and each installation of the input.
std::string gpkg_rows(std::string_view text, const Document& document,
                      std::span<const FeatureRecord> features);

}  // namespace oriel
