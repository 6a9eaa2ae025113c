#include "examples/generator/facade/facade.h"
#include "examples/generator/house/attachments.h"

#include <algorithm>

namespace oriel::generator {
namespace {

/// Gap between a window and its sill or shutters.
constexpr Um kDecorGap = 30'000;

}  // namespace

void Facade::add_window_decor(const Rect& window, const Rect& room) {
  const auto add = [&](std::string_view subclass, const Rect& rect, Um depth) {
    const Rect place{room.u0, room.u1, room.v0, panel_.usable.v1};
    if (place.contains(rect)) add_decor(draft_, panel_, subclass, rect, depth);
  };
  if (has(Feature::sill)) {
    const Um v1 = window.v0 - kDecorGap, side = 50_mm;
    add("sill", {window.u0 - side, window.u1 + side, v1 - 60_mm, v1}, 120_mm);
  }
  if (has(Feature::shutter)) {
    const Um width = window.width() / 2'000 * 1'000, v0 = window.v0, v1 = window.v1;
    const Um left = window.u0 - kDecorGap, right = window.u1 + kDecorGap;
    if (left - width < room.u0 || right + width > room.u1) return;
    add("shutter", {left - width, left, v0, v1}, 40_mm);
    add("shutter", {right, right + width, v0, v1}, 40_mm);
  }
}

void Facade::place_pilasters() {
  const Um v0 = plan_.plinth > 0 ? plan_.plinth + kDistance : 0;
  const Um v1 = std::min(plan_.floor(grid_.rows()) - 400_mm, panel_.usable.v1);
  const Um depth = draw(60_mm, 150_mm), half = draw(120_mm, 180_mm);
  for (int i = 1; i < grid_.columns(); ++i) {
    const Rect rect{grid_.line(i) - half, grid_.line(i) + half, v0, v1};
    if (panel_.is_free(rect, kDistance)) add_decor(draft_, panel_, "pilaster", rect, depth);
  }
}

void Facade::place_cornices() {
  const Um depth = draw(60_mm, 150_mm), height = draw(80_mm, 140_mm);
  for (int row = 1; row <= grid_.rows(); ++row) {
    const Um v1 = plan_.floor(row) - 80_mm, v0 = v1 - height;
    if (v1 > panel_.usable.v1) return;
    for (const Rect& piece : panel_.free_parts(panel_.usable, v0, v1, kDistance))
      if (piece.width() >= 1000_mm) add_decor(draft_, panel_, "cornice", piece, depth);
  }
}

}  // namespace oriel::generator
