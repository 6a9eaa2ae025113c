#pragma once

#include "io/picture/faces.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// Cuts each face down to what no other one hides, as rings in pixels (even-odd, on a grid of
/// 1/1024 pixel): the face minus, for each face that it meets in the picture, where that one is
/// nearer. Faces may pass through each other. In one plane a part is seen before what it lies in,
/// else the later one.
std::vector<std::vector<PictureRing>> visible_rings(std::span<const PictureFace> faces);

/// Measures the area of rings, even-odd, in square pixels; those of visible_rings() do not cross.
double area_px(std::span<const PictureRing> rings);

}  // namespace oriel::detail
