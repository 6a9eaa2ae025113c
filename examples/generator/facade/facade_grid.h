#pragma once

#include "examples/generator/house/house.h"
#include "examples/generator/house/plan.h"

#include <optional>
#include <vector>

namespace oriel::generator {

/// Neighbouring columns over some storeys of a wall.
struct Cell {
  int column = 0, row = 0, span = 1, rows = 1;
};

/// The places for features on a wall: columns of equal width, one row a storey. A cell is free if
/// it is not taken and nothing was reserved in it, or under the lowest row, when the grid was made.
class FacadeGrid {
 public:
  FacadeGrid(const Panel& panel, const Plan& plan);

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  /// The cell's part of the wall, less a border that keeps neighbours apart; from the lowest row's
  /// floor to the next floor over the highest.
  [[nodiscard]] Rect rect(const Cell& cell) const;
  /// The wall coordinate between columns i − 1 and i.
  [[nodiscard]] Um line(int i) const { return left_ + i * width_; }

  [[nodiscard]] bool is_free(const Cell& cell) const;
  void take(const Cell& cell);
  /// A free cell of this size whose lowest row lies in [low, high]; drawn evenly.
  std::optional<Cell> draw(int span, int rows, int low, int high, Random& random) const;
  /// The free cells of the same columns on all storeys but the lowest.
  [[nodiscard]] std::vector<Cell> stack(const Cell& cell) const;
  /// All free cells of one column and row.
  [[nodiscard]] std::vector<Cell> free_cells() const;

 private:
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  const Plan& plan_;
  /// What stood on the wall before; what is placed in cells later takes them.
  std::vector<Rect> reserved_;
  int columns_ = 0, rows_ = 0;
  Um left_ = 0, width_ = 0, border_ = 0;
  std::vector<bool> is_taken_;
};

}  // namespace oriel::generator
