#pragma once

#include "io/picture/drawing.h"
#include "io/picture/picture.h"

#include <map>
#include <span>
#include <string>

namespace oriel::detail {

/// About what a letter of DejaVu Sans takes, of its size; texts are set apart by it.
inline constexpr double kLetter = 0.62;

/// Colours of what stands around the buildings.
struct PictureTheme {
  Colour ground, ink, line;
};
PictureTheme theme_of(bool is_dark);

/// The classes that are shown, each with the number of its features; of 0, and of plain surfaces,
/// no number is written.
using SeenClasses = std::map<std::string, std::size_t>;

/// What a legend explains: classes, and marks with the number of parts that have them.
struct LegendContents {
  SeenClasses classes;
  std::map<PictureMark, std::size_t> marks;
};

Colour colour_of_mark(PictureMark mark);

/// Makes a row of patches with names and numbers, in lines of `within`, from its top on: parts by
/// number, then surfaces, then marks.
PictureGroup legend(const LegendContents& contents, const PictureBox& within,
                    const PictureTheme& theme);
/// Measures what legend() takes of the height.
double legend_height_px(const LegendContents& contents, double width_px);

/// Makes a bar of a round number of metres (1, 2 or 5 times a power of ten) in the box's left lower
/// corner.
PictureGroup scale_bar(const Placing& placing, const PictureTheme& theme);

}  // namespace oriel::detail
