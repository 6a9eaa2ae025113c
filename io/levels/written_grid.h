#pragma once

#include "io/document.h"
#include "model/building.h"
#include "model/labelled_building.h"
#include "model/scale_series.h"
#include "model/solid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace oriel {

/// Where a CityJSON file has the points of its vertices: on the grid that its transform makes.
class WrittenGrid {
 public:
  /// The grid of write_cityjson for a document, whatever the geometries are.
  explicit WrittenGrid(const Document& document);

  /// The grid of a file that can state all points of `states`, no finer than a micrometre.
  WrittenGrid(const Document& document, const std::vector<LevelState>& states);

  /// By how many powers of ten it is finer than the document's: WriteOptions::finer_digits.
  [[nodiscard]] int finer_digits() const { return digits_; }

  /// Where a point of a building's frame is written.
  [[nodiscard]] MicrometrePoint place(Vec3 local_m, const Frame& frame) const;

 private:
  Vec3 scale_, translate_;
  int digits_ = 0;
};

/// The point of a file's vertex: translate + scale × integer, to the micrometre.
MicrometrePoint grid_point(const std::array<std::int64_t, 3>& vertex, Vec3 scale, Vec3 translate);

/// `building`, one of the document, as it is read again after `solid` was written in the place of
/// its polygons: one polygon for each facet (Polygon::source is its number), vertices rounded to
/// the WrittenGrid of the document. Repeated vertices are kept: it is what a validator gets to see.
Building as_written(const Document& document, const Building& building, const Solid& solid);

}  // namespace oriel
