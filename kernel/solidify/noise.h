#pragma once

#include "model/building.h"
#include "model/tolerances.h"

namespace oriel {

/// How far corners lie off the planes of their polygons, in metres: in nine of ten polygons with
/// more than three corners no further (half of what they reach along the polygon's normal). A
/// triangle is flat whatever the noise; where most polygons are triangles, pairs of them count that
/// share the longest side of both, as the halves of a rectangle do. 0 where there are few of
/// either. Coordinates that are rounded to a millimetre show up to 0.6 mm, and noise of ±n about
/// 0.6 n.
double noise_of(const Building& building);

/// The tolerances for a building that noisy: plane_offset_m is no smaller than it was, and where
/// the noise asks for more, more, up to a centimetre. Below that real recesses begin to vanish.
Tolerances fitted_to_noise(Tolerances tolerances, double noise_m);

}  // namespace oriel
