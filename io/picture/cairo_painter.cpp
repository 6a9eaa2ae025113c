#include "io/picture/cairo_library.h"
#include "io/picture/drawing.h"
#include "kernel/base/index.h"

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

namespace oriel::detail {

namespace {

using CairoSurface = std::unique_ptr<cairo_surface_t, decltype(&::cairo_surface_destroy)>;
using CairoPen = std::unique_ptr<cairo_t, decltype(&::cairo_destroy)>;

/// Cairo, which has_cairo().
const CairoLibrary& lib() { return *cairo_library(); }

cairo_status_t append_bytes(void* to, const unsigned char* bytes, unsigned int count) {
  auto& out = *static_cast<std::string*>(to);
  for (unsigned int i = 0; i < count; ++i) out += static_cast<char>(bytes[i]);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(lib().cairo_status_to_string(status));
}

void set_colour(cairo_t* pen, Colour colour) {
  lib().cairo_set_source_rgb(pen, colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0);
}

void draw(cairo_t* pen, const PictureShape& shape) {
  lib().cairo_new_path(pen);
  for (const PictureRing& ring : shape.rings) {
    lib().cairo_new_sub_path(pen);
    for (const PicturePoint p : ring) lib().cairo_line_to(pen, p.x, p.y);
    lib().cairo_close_path(pen);
  }
  if (shape.fill) {
    set_colour(pen, *shape.fill);
    lib().cairo_fill_preserve(pen);
  }
  if (shape.line) {
    set_colour(pen, *shape.line);
    lib().cairo_set_line_width(pen, shape.line_px);
    lib().cairo_stroke_preserve(pen);
  }
  lib().cairo_new_path(pen);
}

void draw(cairo_t* pen, const PictureText& text) {
  lib().cairo_set_font_size(pen, text.size_px);
  cairo_text_extents_t extents;
  lib().cairo_text_extents(pen, text.text.c_str(), &extents);
  const double x =
      text.anchor == TextAnchor::middle ? text.at.x - extents.x_advance / 2 : text.at.x;
  set_colour(pen, text.colour);
  lib().cairo_move_to(pen, x, text.at.y);
  lib().cairo_show_text(pen, text.text.c_str());
}

void draw_groups(cairo_surface_t* surface, const PictureDrawing& drawing) {
  const CairoPen pen(lib().cairo_create(surface), lib().cairo_destroy);
  lib().cairo_set_fill_rule(pen.get(), CAIRO_FILL_RULE_EVEN_ODD);
  lib().cairo_set_line_join(pen.get(), CAIRO_LINE_JOIN_ROUND);
  lib().cairo_select_font_face(pen.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                               CAIRO_FONT_WEIGHT_NORMAL);
  for (const PictureGroup& group : drawing.groups) {
    for (const PictureShape& shape : group.shapes) draw(pen.get(), shape);
    for (const PictureText& text : group.texts) draw(pen.get(), text);
  }
  check(lib().cairo_status(pen.get()));
}

/// Red, green and blue times opacity, in one number, as Cairo has them.
std::uint32_t premultiplied(const std::array<std::uint8_t, 4>& pixel) {
  std::uint32_t out = std::uint32_t{pixel[3]} << 24U;
  for (std::size_t i = 0; i < 3; ++i)
    out |= ((std::uint32_t{pixel[i]} * pixel[3] + 127) / 255) << (16 - 8 * i);
  return out;
}

}  // namespace

bool has_cairo() { return cairo_library() != nullptr; }

std::string pdf_of(std::span<const PictureDrawing> pages) {
  constexpr double kPoint_px = 72.0 / 96;
  std::string out;
  const CairoSurface surface(lib().cairo_pdf_surface_create_for_stream(
                                 append_bytes, &out, pages.front().width_px * kPoint_px,
                                 pages.front().height_px * kPoint_px),
                             lib().cairo_surface_destroy);
  // No time of day: the same bytes twice.
  lib().cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                       "2000-01-01T00:00:00Z");
  lib().cairo_surface_set_device_scale(surface.get(), kPoint_px, kPoint_px);
  for (const PictureDrawing& page : pages) {
    const double w = page.width_px, h = page.height_px;
    PictureDrawing ground;
    if (page.ground)
      ground.groups = {
          {.shapes = {{.rings = {{{0, 0}, {w, 0}, {w, h}, {0, h}}}, .fill = page.ground}}}};
    draw_groups(surface.get(), ground);
    draw_groups(surface.get(), page);
    lib().cairo_surface_show_page(surface.get());
  }
  lib().cairo_surface_finish(surface.get());
  check(lib().cairo_surface_status(surface.get()));
  return out;
}

std::string png_of(const PictureDrawing& drawing, const Raster& raster) {
  const CairoSurface surface(
      lib().cairo_image_surface_create(CAIRO_FORMAT_ARGB32, raster.width, raster.height),
      lib().cairo_surface_destroy);
  check(lib().cairo_surface_status(surface.get()));
  unsigned char* bytes = lib().cairo_image_surface_get_data(surface.get());
  const int stride = lib().cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) {
      const std::uint32_t value = premultiplied(raster.pixels[at(y) * at(raster.width) + at(x)]);
      std::memcpy(bytes + std::ptrdiff_t{y} * stride + std::ptrdiff_t{x} * 4, &value, 4);
    }
  lib().cairo_surface_mark_dirty(surface.get());
  draw_groups(surface.get(), drawing);
  std::string out;
  check(lib().cairo_surface_write_to_png_stream(surface.get(), append_bytes, &out));
  return out;
}

}  // namespace oriel::detail
