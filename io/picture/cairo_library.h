#pragma once

#include <cairo/cairo-pdf.h>
#include <cairo/cairo.h>

namespace oriel::detail {

// What is called of Cairo.
#define ORIEL_CAIRO_FUNCTIONS(X)         \
  X(cairo_create)                        \
  X(cairo_destroy)                       \
  X(cairo_status)                        \
  X(cairo_status_to_string)              \
  X(cairo_set_source_rgb)                \
  X(cairo_set_fill_rule)                 \
  X(cairo_set_line_join)                 \
  X(cairo_set_line_width)                \
  X(cairo_new_path)                      \
  X(cairo_new_sub_path)                  \
  X(cairo_move_to)                       \
  X(cairo_line_to)                       \
  X(cairo_close_path)                    \
  X(cairo_fill_preserve)                 \
  X(cairo_stroke_preserve)               \
  X(cairo_select_font_face)              \
  X(cairo_set_font_size)                 \
  X(cairo_text_extents)                  \
  X(cairo_show_text)                     \
  X(cairo_image_surface_create)          \
  X(cairo_image_surface_get_data)        \
  X(cairo_image_surface_get_stride)      \
  X(cairo_pdf_surface_create_for_stream) \
  X(cairo_pdf_surface_set_metadata)      \
  X(cairo_surface_destroy)               \
  X(cairo_surface_finish)                \
  X(cairo_surface_mark_dirty)            \
  X(cairo_surface_set_device_scale)      \
  X(cairo_surface_show_page)             \
  X(cairo_surface_status)                \
  X(cairo_surface_write_to_png_stream)

/// The functions of Cairo, by their names there.
struct CairoLibrary {
#define ORIEL_CAIRO_MEMBER(name) decltype(&::name) name = nullptr;
  ORIEL_CAIRO_FUNCTIONS(ORIEL_CAIRO_MEMBER)
#undef ORIEL_CAIRO_MEMBER
};

/// Opens Cairo when it is first asked for; null where it is not installed. It brings some thirty
/// libraries, which would make every start of the program a third longer.
const CairoLibrary* cairo_library();

}  // namespace oriel::detail
