#pragma once

#include "examples/cuts/view.h"

#include <array>
#include <optional>

namespace oriel::cuts {

/// Samples a pixel and direction, and the picture's size in pixels; the loupe is a square.
inline constexpr int kFiner = 4, kPictureWidth = 240, kPictureHeight = 190, kLoupe = 60;

/// A body from one of its four sides.
struct Shot {
  const char* side = "";
  Camera eye;
  Image image;
  /// The parts alone, where they are small in the picture.
  std::optional<Image> loupe;
};

/// Samples a metre with which the pieces fill a picture from every side.
double scale_of(const Segmentation& segmentation, const std::vector<Piece>& pieces);

/// From the side that shows most of the parts; from the front right where none is better by far.
Shot best_shot(const Segmentation& segmentation, const std::vector<Piece>& pieces, double scale);

}  // namespace oriel::cuts
