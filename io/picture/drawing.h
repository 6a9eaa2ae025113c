#pragma once

#include "io/picture/raster.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oriel::detail {

/// A figure of rings (even-odd).
struct PictureShape {
  std::vector<PictureRing> rings;
  std::optional<Colour> fill{};
  std::optional<Colour> line{};
  double line_px = 1;
};

enum class TextAnchor { start, middle };

struct PictureText {
  PicturePoint at;  ///< on the base line
  std::string text;
  double size_px = 14;
  TextAnchor anchor = TextAnchor::start;
  Colour colour{};
};

/// What belongs together in a picture: a part, a legend.
struct PictureGroup {
  std::string id{};
  std::string label{};
  std::vector<PictureShape> shapes{};
  std::vector<PictureText> texts{};
};

/// A picture as groups, each over those before.
struct PictureDrawing {
  int width_px = 0, height_px = 0;
  std::optional<Colour> ground{};
  std::vector<PictureGroup> groups{};
};

/// Writes a drawing as SVG, a group of it as an element `g`.
std::string svg_of(const PictureDrawing& drawing);
/// Says whether Cairo is installed, which pdf_of() and png_of() take.
bool has_cairo();
/// Writes drawings as pages of one size, that of the first; a pixel is 1/96 inch.
std::string pdf_of(std::span<const PictureDrawing> pages);
/// Draws the groups over the raster, which has the size of the drawing.
std::string png_of(const PictureDrawing& drawing, const Raster& raster);

}  // namespace oriel::detail
