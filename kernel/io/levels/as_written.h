#pragma once

#include "kernel/io/document.h"
#include "kernel/model/building.h"
#include "kernel/model/solid.h"

namespace oriel {

/// By how many powers of ten write_cityjson may make the scale of a document finer, from the one
/// that it has or 0.001 on: 0 for a line of a CityJSONSeq, whose header has the transform.
int spare_digits(const Document& document);

/// `building`, one of the document, as it is read again after `solid` was written in the place of
/// its polygons: one polygon for each facet (Polygon::source is its number), vertices rounded to
/// the transform's scale, which is finer by `digits` powers of ten. Repeated vertices are kept: it
/// is what a validator gets to see.
Building as_written(const Document& document, const Building& building, const Solid& solid,
                    int digits);

}  // namespace oriel
