#include "examples/generator/facade/facade.h"
#include "examples/generator/facade/openings.h"
#include "examples/generator/house/attachments.h"

#include <algorithm>

namespace oriel::generator {

bool Facade::place_entrance() {
  const std::optional<Cell> cell = grid_.draw(1, 1, 0, 0, random_);
  if (!cell || grid_.rect(*cell).width() < 1700_mm) return false;
  grid_.take(*cell);
  const Rect room = grid_.rect(*cell);
  const Um threshold = random_.chance(0.5) ? 0 : draw(20_mm, 150_mm);
  const Um v0 = plan_.steps > 0 ? plan_.base : threshold;
  const Um width = draw(900_mm, 1200_mm), height = draw(2000_mm, 2200_mm);
  const Rect door = in_middle(room.grown(-250_mm), width, v0, height);
  add_door(panel_, door, "Door");
  if (plan_.steps > 0) add_stairs_before(door);
  if (has(Feature::canopy)) add_canopy_over(door, room.v1 - kBelowFloor);
  return true;
}

void Facade::add_door(Panel& panel, const Rect& rect, std::string_view subclass) {
  Opening door{Class::door, std::string(subclass), rect, draw_recess()};
  if (has(Feature::panes) && random_.chance(0.4)) {
    door.columns = rect.width() >= 1200_mm ? 2 : 1;
    door.rows = random_.between(2, 3);
  }
  add_opening(draft_, panel, door);
}

void Facade::add_stairs_before(const Rect& door) {
  const Um side = draw(100_mm, 250_mm), landing = draw(400_mm, 1100_mm);
  const Um tread = draw(270_mm, 320_mm);
  add_stairs(draft_, panel_, {door.u0 - side, door.u1 + side, 0, plan_.base}, plan_.steps, landing,
             tread);
}

void Facade::add_canopy_over(const Rect& door, Um limit) {
  const Um side = draw(50_mm, 250_mm), v0 = door.v1 + draw(kDistance, 150_mm);
  const Um height = draw(100_mm, 200_mm);
  const Rect rect{door.u0 - side, door.u1 + side, v0, v0 + height};
  const Um depth = draw(700_mm, 1400_mm), fall = random_.chance(0.5) ? 0 : height / 2'000 * 1'000;
  if (rect.v1 <= limit && panel_.is_free(rect, kDistance / 2))
    add_canopy(draft_, panel_, rect, depth, fall);
}

bool Facade::place_garage() {
  std::optional<Cell> cell = grid_.draw(random_.between(1, 2), 1, 0, 0, random_);
  if (!cell) cell = grid_.draw(1, 1, 0, 0, random_);
  if (!cell || grid_.rect(*cell).width() < 2300_mm) return false;
  grid_.take(*cell);
  const Rect room = grid_.rect(*cell);
  const Um width = draw(2200_mm, std::min(room.width(), 5000_mm));
  add_door(panel_, in_middle(room, width, 0, draw(2000_mm, 2250_mm)), "garageDoor");
  return true;
}

void Facade::add_french_door(Panel& panel, const Rect& room, Um floor) {
  const Um v0 = floor + (random_.chance(0.3) ? 0 : draw(20_mm, 60_mm));
  const Um width = draw(800_mm, std::min(room.width(), 1800_mm));
  add_door(panel, in_middle(room, width, v0, draw(1950_mm, 2150_mm)), "frenchWindow");
}

void Facade::place_windows() {
  for (const Cell& cell : grid_.free_cells()) {
    if (!random_.chance(plan_.density)) continue;
    Rect room = grid_.rect(cell);
    room.v1 = std::min(room.v1, panel_.usable.v1);
    std::string_view subclass = "Window";
    if (has(Feature::french_window) && cell.row > 0 && random_.chance(0.2))
      subclass = "frenchWindow";
    if (has(Feature::shop) && cell.row == 0 && panel_.is_front) subclass = "shopWindow";
    grid_.take(cell);
    if (!add_window(panel_, room, room.v0, subclass)) continue;
    const Rect window = panel_.reserved.back();
    if (subclass == "Window") add_window_decor(window, room);
    if (has(Feature::cellar_window) && cell.row == 0) add_cellar_window(room);
  }
}

bool Facade::add_window(Panel& panel, const Rect& room, Um floor, std::string_view subclass) {
  WindowStyle style = plan_.window;
  if (subclass == "shopWindow")
    style = {draw(1600_mm, 2600_mm), draw(1600_mm, 1900_mm), draw(400_mm, 600_mm), style.recess};
  if (subclass == "frenchWindow")
    style = {draw(800_mm, 1400_mm), draw(1950_mm, 2100_mm), draw(20_mm, 80_mm), style.recess};
  const Rect place{room.u0, room.u1, std::max(room.v0, floor + 20_mm),
                   std::min(room.v1, floor + plan_.storey_height - kBelowFloor)};
  style.width = std::min(style.width, place.width());
  style.height = std::min(style.height, place.v1 - floor - style.sill_height);
  if (style.width < 400_mm || style.height < 400_mm) return false;
  const Um u0 = room.middle() / 1'000 * 1'000 - style.width / 2'000 * 1'000;
  const Um v0 = floor + style.sill_height;
  const Rect rect = jittered({u0, u0 + style.width, v0, v0 + style.height}, place);
  const bool has_frame = rect.width() >= 600_mm && rect.height() >= 700_mm;
  add_opening(draft_, panel,
              {Class::window, std::string(subclass), rect, draw_recess(),
               has_frame ? style.columns : 1, has_frame ? style.rows : 1});
  return true;
}

Rect Facade::jittered(Rect rect, const Rect& room) {
  if (plan_.jitter == 0) return rect;
  const auto moved = [&](Um value, Um low, Um high) {
    return std::clamp(value + draw(-plan_.jitter, plan_.jitter, 1'000), low, high);
  };
  const Um du = draw(-plan_.jitter, plan_.jitter, 1'000);
  const Um dv = draw(-plan_.jitter, plan_.jitter, 1'000);
  rect = rect.moved(du, dv);
  const Um smallest = 400_mm;
  rect.u0 = moved(rect.u0, room.u0, room.u1 - smallest);
  rect.u1 = moved(rect.u1, rect.u0 + smallest, room.u1);
  rect.v0 = moved(rect.v0, room.v0, room.v1 - smallest);
  rect.v1 = moved(rect.v1, rect.v0 + smallest, room.v1);
  return rect;
}

Rect Facade::in_middle(const Rect& room, Um width, Um v0, Um height) {
  const Um play = room.width() - width;
  const Um u0 = room.u0 + draw(play / 3'000 * 1'000, play / 3'000 * 2'000);
  return {u0, u0 + width, v0, v0 + height};
}

void Facade::add_cellar_window(const Rect& room) {
  const Um v0 = plan_.plinth + 120_mm, v1 = plan_.base - 150_mm;
  if (v1 - v0 < 280_mm) return;
  const Rect rect{room.middle() / 1'000 * 1'000 - 350_mm, room.middle() / 1'000 * 1'000 + 350_mm,
                  v0, v1};
  if (panel_.is_free(rect, kDistance))
    add_opening(draft_, panel_, {Class::window, "cellarWindow", rect, draw_recess()});
}

void Facade::place_strip() {
  std::optional<Cell> cell = grid_.draw(2, 1, 0, grid_.rows() - 1, random_);
  if (!cell) cell = grid_.draw(1, 1, 0, grid_.rows() - 1, random_);
  if (!cell) return;
  const Rect room = grid_.rect(*cell);
  const int count = random_.between(3, 5);
  const Um gap = draw(80_mm, 150_mm), recess = draw_recess();
  const Um width = std::min((room.width() - (count - 1) * gap) / count / 1'000 * 1'000, 1000_mm);
  const Um v0 = room.v0 + plan_.window.sill_height;
  const Um v1 = std::min({v0 + plan_.window.height, room.v1 - kBelowFloor, panel_.usable.v1});
  if (width < 400_mm || v1 - v0 < 400_mm) return;
  grid_.take(*cell);
  for (int i = 0; i < count; ++i) {
    const Um u0 = room.u0 + i * (width + gap);
    add_opening(draft_, panel_, {Class::window, "Window", {u0, u0 + width, v0, v1}, recess});
  }
}

}  // namespace oriel::generator
