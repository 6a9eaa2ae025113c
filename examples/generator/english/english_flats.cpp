#include "examples/generator/english/english_flats.h"

#include "examples/generator/english/english_entrance.h"
#include "examples/generator/english/english_front.h"
#include "examples/generator/house/attachments.h"

#include <algorithm>

// Where sizes come from: guards of balconies 1100 mm high: Approved Document K (2013), which old
// parapets rarely reach.

namespace oriel::generator {
namespace {

/// What flats have before or behind their wall.
enum class OpenRoom { none, loggia, balcony };

/// One block; what is open on the street and on the garden is drawn once.
class FlatsLayout {
 public:
  explicit FlatsLayout(const EnglishSite& site)
      : site_(site), plan_(site.plan), street_(draw_room(0.55)), garden_(draw_room(0.15)) {}

  void fill_street(Panel& panel);
  void fill_garden(Panel& panel);
  void fill_end(Panel& panel);

 private:
  [[nodiscard]] OpenRoom draw_room(double loggias) const;
  [[nodiscard]] Rect band(const Panel& panel, Um u0, Um u1, int storey) const;
  [[nodiscard]] EnglishWindow window_at(int storey) const;
  void fill_half(Panel& panel, Um corner, Um stairs);
  void place_open_room(Panel& panel, const Rect& room, OpenRoom kind);
  void place_loggia_room(Panel& panel, const Rect& room);
  void place_balcony_room(Panel& panel, const Rect& room);

  const EnglishSite& site_;
  const EnglishPlan& plan_;
  OpenRoom street_, garden_;
};

OpenRoom FlatsLayout::draw_room(double loggias) const {
  if (site_.chance(loggias)) return OpenRoom::loggia;
  return site_.chance(0.6) ? OpenRoom::balcony : OpenRoom::none;
}

Rect FlatsLayout::band(const Panel& panel, Um u0, Um u1, int storey) const {
  return {std::min(u0, u1), std::max(u0, u1), plan_.floor(storey) + 300_mm,
          std::min(plan_.floor(storey + 1) - 300_mm, panel.usable.v1 - 60_mm)};
}

EnglishWindow FlatsLayout::window_at(int storey) const {
  EnglishWindow window;
  const Um v0 = plan_.floor(storey) + 750_mm;
  window.rect = {0, plan_.window_width, v0, v0 + 1524_mm};
  window.glazing = plan_.glazing;
  window.lights = 2;
  window.is_dressed = true;
  return window;
}

/// A room open to the front, at its back a door and a window.
void FlatsLayout::place_loggia_room(Panel& panel, const Rect& room) {
  const Um parapet = site_.chance(0.8) ? site_.length(900_mm, 1100_mm) : 0;
  const Um floor = room.v0;
  Panel back = add_loggia(site_.draft, panel, room, site_.length(1100_mm, 1500_mm), parapet);
  const Rect& inside = back.usable;
  const Um split = inside.u0 + inside.width() / 2'000 * 1'000;
  const Rect left{inside.u0, split - 60_mm, floor, inside.v1};
  const Um width = std::min(left.width() - 100_mm, site_.length(800_mm, 1300_mm)) / 2'000 * 2'000;
  const Um height = std::min(2150_mm, inside.v1 - floor - 100_mm);
  add_plain_door(site_, back, centred(left, width, floor, height), "frenchWindow");
  const Rect right{split + 60_mm, inside.u1, floor + 600_mm, inside.v1};
  EnglishWindow window;
  window.glazing = plan_.glazing;
  window.lights = 2;
  window.rect = {0, std::min(plan_.window_width, right.width()), floor + 900_mm, floor + 2150_mm};
  place_window_row(site_, back, right, 1, window);
}

void FlatsLayout::place_balcony_room(Panel& panel, const Rect& room) {
  place_english_balcony(site_, panel, room, site_.length(900_mm, 1100_mm));
  const Um widest = room.width() - 500_mm;
  const Um width = std::min(widest, site_.length(900_mm, 1500_mm)) / 2'000 * 2'000;
  const Um threshold = site_.chance(0.5) ? 0 : 40_mm;
  add_plain_door(site_, panel, centred(room, width, room.v0 + threshold, 2100_mm), "frenchWindow");
}

void FlatsLayout::place_open_room(Panel& panel, const Rect& room, OpenRoom kind) {
  const Rect from_floor{room.u0, room.u1, room.v0 - 300_mm, room.v1};
  if (kind == OpenRoom::loggia) place_loggia_room(panel, from_floor);
  if (kind == OpenRoom::balcony) place_balcony_room(panel, from_floor);
}

/// From the corner to the stairs: a bay or windows, then loggias or balconies above windows.
void FlatsLayout::fill_half(Panel& panel, Um corner, Um stairs) {
  const Um middle = (corner + stairs) / 2'000 * 1'000, gap = corner < stairs ? 200_mm : -200_mm;
  Um over_bay = 0;
  if (plan_.bay.storeys > 0)
    over_bay = place_bay_window(site_, panel, band(panel, corner, middle - gap, 0),
                                plan_.wall_height() - 450_mm, plan_.wall_height() - 120_mm);
  for (int storey = 0; storey < plan_.storeys(); ++storey) {
    const Rect outer = band(panel, corner, middle - gap, storey);
    const Rect inner = band(panel, middle + gap, stairs, storey);
    if (over_bay == 0) place_window_row(site_, panel, outer, 2, window_at(storey));
    if (storey > 0 && street_ != OpenRoom::none && inner.width() >= 2000_mm)
      place_open_room(panel, inner, street_);
    else
      place_window_row(site_, panel, inner, inner.width() >= 3000_mm ? 2 : 1, window_at(storey));
  }
}

void FlatsLayout::fill_street(Panel& panel) {
  const Um width = plan_.width(), middle = width / 2'000 * 1'000, stairs = 1300_mm;
  const Um top = place_entrance(site_, panel, middle, plan_.floor(1) - 300_mm).v1;
  for (int storey = 1; storey < plan_.storeys(); ++storey) {
    Rect room = band(panel, middle - 900_mm, middle + 900_mm, storey);
    room.v0 = std::max(room.v0, top + 100_mm);
    place_window_row(site_, panel, room, 1, window_at(storey));
  }
  fill_half(panel, 600_mm, middle - stairs);
  fill_half(panel, width - 600_mm, middle + stairs);
}

/// Columns of 2.8 m: kitchens with balconies or loggias above back doors, rooms, and baths.
void FlatsLayout::fill_garden(Panel& panel) {
  const Um length = plan_.width() - 800_mm;
  const int columns = static_cast<int>(length / 2800_mm);
  const Um pitch = length / columns / 1'000 * 1'000;
  for (int storey = 0; storey < plan_.storeys(); ++storey)
    for (int column = 0; column < columns; ++column) {
      const Um u0 = 400_mm + column * pitch;
      const Rect room = band(panel, u0 + 150_mm, u0 + pitch - 150_mm, storey);
      const bool is_kitchen = column == 1 || column == columns - 2;
      if (storey > 0 && is_kitchen && garden_ != OpenRoom::none) {
        place_open_room(panel, room, garden_);
      } else if (storey == 0 && is_kitchen) {
        const Um v0 = std::min<Um>(plan_.floor(0), 150_mm);
        add_english_door(site_, panel, (room.u0 + room.u1) / 2, v0, true);
      } else {
        EnglishWindow window = window_at(storey);
        if (column % 3 == 2) window.rect = {0, 610_mm, window.rect.v0 + 500_mm, window.rect.v1};
        place_window_row(site_, panel, room, 1, window);
      }
    }
}

void FlatsLayout::fill_end(Panel& panel) {
  if (site_.chance(0.4)) return;
  for (int storey = 0; storey < plan_.storeys(); ++storey)
    place_window_row(site_, panel, band(panel, 1500_mm, plan_.depth - 1500_mm, storey), 2,
                     window_at(storey));
}

}  // namespace

void lay_out_flats(const EnglishSite& site, House& house) {
  FlatsLayout layout(site);
  layout.fill_street(house.walls[0]);
  layout.fill_garden(house.walls[1]);
  layout.fill_end(house.walls[2]);
  layout.fill_end(house.walls[3]);
}

}  // namespace oriel::generator
