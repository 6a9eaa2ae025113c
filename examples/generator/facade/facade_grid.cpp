#include "examples/generator/facade/facade_grid.h"

#include <algorithm>

namespace oriel::generator {

FacadeGrid::FacadeGrid(const Panel& panel, const Plan& plan)
    : plan_(plan), reserved_(panel.reserved) {
  const Um length = panel.usable.width();
  constexpr Um narrowest = 1400_mm;
  if (length >= narrowest) columns_ = std::max(1, static_cast<int>(length / plan.column_width));
  if (columns_ == 0) return;
  left_ = panel.usable.u0;
  width_ = length / columns_ / 10'000 * 10'000;
  border_ = plan.has(Feature::pilaster) ? 300_mm : 50_mm;
  // Where eaves hang over, the usable part ends up to half a metre below the wall's top.
  rows_ = static_cast<int>((panel.usable.v1 + 600_mm - plan.base) / plan.storey_height);
  rows_ = std::min(rows_, plan.storeys);
  is_taken_.assign(index(0, rows_), false);
}

Rect FacadeGrid::rect(const Cell& cell) const {
  return {line(cell.column) + border_, line(cell.column + cell.span) - border_,
          plan_.floor(cell.row), plan_.floor(cell.row + cell.rows)};
}

bool FacadeGrid::is_free(const Cell& cell) const {
  for (int row = cell.row; row < cell.row + cell.rows; ++row)
    for (int column = cell.column; column < cell.column + cell.span; ++column)
      if (is_taken_[index(column, row)]) return false;
  Rect place = rect(cell);
  if (cell.row == 0) place.v0 = 0;  // stairs and garages reach down to the ground
  return std::ranges::none_of(reserved_, [&](const Rect& r) { return r.overlaps(place); });
}

void FacadeGrid::take(const Cell& cell) {
  for (int row = cell.row; row < cell.row + cell.rows; ++row)
    for (int column = cell.column; column < cell.column + cell.span; ++column)
      is_taken_[index(column, row)] = true;
}

std::optional<Cell> FacadeGrid::draw(int span, int rows, int low, int high, Random& random) const {
  std::vector<Cell> cells;
  for (int row = low; row <= std::min(high, rows_ - rows); ++row)
    for (int column = 0; column + span <= columns_; ++column)
      if (const Cell cell{column, row, span, rows}; is_free(cell)) cells.push_back(cell);
  if (cells.empty()) return std::nullopt;
  return cells[static_cast<std::size_t>(random.below(static_cast<int>(cells.size())))];
}

std::vector<Cell> FacadeGrid::stack(const Cell& cell) const {
  std::vector<Cell> cells;
  for (int row = 1; row < rows_; ++row)
    if (const Cell other{cell.column, row, cell.span, 1}; is_free(other)) cells.push_back(other);
  return cells;
}

std::vector<Cell> FacadeGrid::free_cells() const {
  std::vector<Cell> cells;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      if (const Cell cell{column, row}; is_free(cell)) cells.push_back(cell);
  return cells;
}

}  // namespace oriel::generator
