#include "examples/generator/facade/facade.h"
#include "examples/generator/house/attachments.h"

#include <algorithm>

namespace oriel::generator {

bool Facade::place_bay() {
  const int rows = random_.between(1, 2);
  const std::optional<Cell> cell = grid_.draw(1, rows, 0, 1, random_);
  if (!cell) return false;
  const Rect room = grid_.rect(*cell);
  const Um width = draw(1800_mm, std::min(room.width(), 3000_mm));
  const Um v0 = cell->row == 0 ? 0 : room.v0 - 200_mm;
  const Um v1 = std::min(room.v1 - kBelowFloor, panel_.usable.v1);
  Bay bay{in_middle(room, width, v0, v1 - v0), draw(500_mm, 1100_mm)};
  if (random_.chance(0.35))
    bay.splay = std::min(bay.depth / 2'000 * 1'000, 350_mm);
  else if (random_.chance(0.5))
    bay.fall = draw(100_mm, 200_mm);
  if (room.width() < 1800_mm || !panel_.is_free(bay.rect, kDistance)) return false;
  grid_.take(*cell);
  Panel front = add_bay(draft_, panel_, bay);
  for (int row = cell->row; row < cell->row + cell->rows; ++row)
    add_window(front, front.usable, plan_.floor(row), "Window");
  return true;
}

bool Facade::place_balconies() {
  const std::optional<Cell> cell =
      grid_.draw(random_.between(1, 2), 1, 1, grid_.rows() - 1, random_);
  if (!cell || grid_.rect(*cell).width() < 1500_mm) return false;
  if (!random_.chance(0.5)) return add_balcony_at(*cell);
  bool has_any = false;
  for (const Cell& other : grid_.stack(*cell)) has_any |= add_balcony_at(other);
  return has_any;
}

bool Facade::add_balcony_at(const Cell& cell) {
  const Rect room = grid_.rect(cell);
  const Um slab = draw(150_mm, 200_mm), floor = room.v0;
  Balcony balcony{{room.u0, room.u1, floor - slab, floor}, draw(900_mm, 1600_mm), slab};
  if (random_.chance(0.85)) {
    balcony.parapet = draw(100_mm, 160_mm, 20_mm);
    balcony.rect.v1 = floor + draw(850_mm, 1100_mm);
    if (random_.chance(0.3)) balcony.screens = draw(600_mm, 1000_mm);
  }
  const Rect whole{room.u0, room.u1, floor - slab, balcony.rect.v1 + balcony.screens};
  if (!panel_.is_free(whole, kDistance / 2)) return false;
  grid_.take(cell);
  add_balcony(draft_, panel_, balcony);
  const Rect inside = room.grown(-balcony.parapet - kDistance);
  const Rect first{inside.u0, inside.u0 + inside.width() / cell.span, room.v0, room.v1};
  const Rect second{first.u1 + kDistance, inside.u1, room.v0, room.v1};
  add_french_door(panel_, first, floor);
  if (cell.span > 1 && has(Feature::window)) add_window(panel_, second, floor, "Window");
  return true;
}

bool Facade::place_loggias() {
  const std::optional<Cell> cell =
      grid_.draw(random_.between(1, 2), 1, 1, grid_.rows() - 1, random_);
  if (!cell) return false;
  if (!random_.chance(0.6)) return add_loggia_at(*cell);
  bool has_any = false;
  for (const Cell& other : grid_.stack(*cell)) has_any |= add_loggia_at(other);
  return has_any;
}

bool Facade::add_loggia_at(const Cell& cell) {
  const Rect room = grid_.rect(cell);
  const Rect opening{std::max(room.u0, panel_.usable.u0 + kCornerMargin),
                     std::min(room.u1, panel_.usable.u1 - kCornerMargin), room.v0,
                     room.v1 - kBelowFloor};
  if (opening.width() < 1800_mm || !panel_.is_free(opening, kDistance / 2)) return false;
  grid_.take(cell);
  const Um parapet = random_.chance(0.5) ? 0 : draw(850_mm, 1050_mm);
  Panel back = add_loggia(draft_, panel_, opening, draw(1200_mm, 1600_mm), parapet);
  const Rect& inside = back.usable;
  const bool has_window = inside.width() >= 2600_mm && has(Feature::window);
  const Um share = has_window ? inside.width() / 2'000 * 1'000 : inside.width();
  add_french_door(back, {inside.u0, inside.u0 + share, inside.v0, inside.v1}, room.v0);
  if (has_window)
    add_window(back, {inside.u0 + share + kDistance, inside.u1, inside.v0, inside.v1}, room.v0,
               "Window");
  return true;
}

}  // namespace oriel::generator
