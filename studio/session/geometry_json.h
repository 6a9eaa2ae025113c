#pragma once

#include "model/building.h"
#include "oriel/result.h"
#include "studio/session/request_body.h"

#include <cstdint>
#include <vector>

namespace oriel::studio {

std::int64_t whole_millimetres(double metres);

/// Numbers of points and boxes as the page has them: in whole millimetres from `origin_m`.
StudioJson box_mm_json(const Box& box, const Vec3& origin_m);
/// Of vertices that are local to `frame`, one number after the other.
StudioJson vertices_mm_json(const std::vector<Vec3>& vertices, const Frame& frame,
                            const Vec3& origin_m);
/// In metres, to the millimetre.
StudioJson point_json(const Vec3& p);

}  // namespace oriel::studio
