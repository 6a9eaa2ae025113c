#include "kernel/solidify/mend/windings.h"

#include "kernel/base/index.h"
#include "kernel/geometry/planar.h"
#include "kernel/solidify/crossings/faces.h"

#include <cmath>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

class WindingFinder {
 public:
  WindingFinder(const Soup& soup, const PolygonCells& cells)
      : soup_(soup), cells_(cells), winding_(2 * soup.polygons.size()) {
    beside_.resize(winding_.size());
    for (int p = 0; p < soup.polygon_count(); ++p) {
      beside_[at(cells.front[at(p)])].push_back(p);
      beside_[at(cells.back[at(p)])].push_back(p);
    }
  }

  std::optional<Numbers> run() {
    std::vector<char> is_done(at(cells_.piece_count), 0);
    for (int p = 0; p < soup_.polygon_count(); ++p) {
      const int piece = cells_.piece[at(p)];
      if (std::exchange(is_done[at(piece)], 1)) continue;
      reach(cells_.outer[at(piece)], winding_of_others(p));
      spread();
    }
    if (is_contradictory_) return std::nullopt;
    Numbers front;
    for (const int cell : cells_.front) front.push_back(*winding_[at(cell)]);
    return front;
  }

 private:
  void reach(int cell, int winding) {
    auto& known = winding_[at(cell)];
    if (known) {
      is_contradictory_ |= *known != winding;
      return;
    }
    known = winding;
    reached_.push_back(cell);
  }

  void spread() {
    while (!reached_.empty()) {
      const int cell = reached_.back();
      reached_.pop_back();
      const int winding = *winding_[at(cell)];
      for (const int p : beside_[at(cell)]) {
        if (cells_.front[at(p)] == cell) reach(cells_.back[at(p)], winding + 1);
        if (cells_.back[at(p)] == cell) reach(cells_.front[at(p)], winding - 1);
      }
    }
  }

  /// How often the other pieces of its body wind round the piece of a polygon.
  [[nodiscard]] int winding_of_others(int polygon) const {
    if (cells_.piece_count == 1) return 0;
    const auto ring = soup_.corners_of(polygon);
    const Vec3 eye = 0.5 * (exact::to_metres(soup_.points[at(ring[0])], 1) +
                            exact::to_metres(soup_.points[at(ring[1])], 1));
    double sum = 0;
    for (int p = 0; p < soup_.polygon_count(); ++p)
      if (cells_.piece[at(p)] != cells_.piece[at(polygon)] &&
          soup_.polygons[at(p)].body == soup_.polygons[at(polygon)].body)
        sum += winding_part(outlines_of(soup_, p), eye);
    return static_cast<int>(std::lround(sum));
  }

  const Soup& soup_;
  const PolygonCells& cells_;
  std::vector<std::optional<int>> winding_;  ///< by cell
  std::vector<Numbers> beside_;              ///< by cell its polygons
  Numbers reached_;
  bool is_contradictory_ = false;
};

}  // namespace

std::optional<Numbers> find_windings(const Soup& soup, const PolygonCells& cells) {
  return WindingFinder(soup, cells).run();
}

}  // namespace oriel::detail
