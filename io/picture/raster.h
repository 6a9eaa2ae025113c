#pragma once

#include "io/picture/faces.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace oriel::detail {

/// Pixels row by row from the top, red, green, blue and opacity, colours not multiplied by it.
struct Raster {
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 4>> pixels;
};

/// Draws faces into a raster by a depth buffer: nearer ones hide others, of faces in one place the
/// later one is seen. Between faces of different planes or parts there are thin lines, about the
/// silhouette and about marked parts thicker ones.
///
/// Memory is by the width of the raster: it is drawn in bands.
void draw_faces(std::span<const PictureFace> faces, const PictureBox& within, Raster& raster);

/// Counts the pixels of each face that can be seen, before lines are drawn: of a raster of that
/// size, each pixel of kFiner × kFiner samples, as a share of them. For tests of visible_rings().
std::vector<double> seen_pixels(std::span<const PictureFace> faces, int width, int height);

}  // namespace oriel::detail
