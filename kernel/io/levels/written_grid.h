#pragma once

#include "kernel/io/document.h"
#include "kernel/model/building.h"
#include "kernel/model/labelled_building.h"
#include "kernel/model/scale_series.h"
#include "kernel/model/solid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace oriel {

/// Where a CityJSON file has the points of its vertices: on the grid that its transform makes.
class WrittenGrid {
 public:
  /// The grid of write_cityjson for a document, fine enough for the geometries of all of
  /// `labelled` (and for LabelledBuilding::digits), which need not go into one file.
  WrittenGrid(const Document& document, const std::vector<const LabelledBuilding*>& labelled);

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

/// By how many powers of ten write_cityjson may make the scale of a document finer, from the one
/// that it has or 0.001 on: 0 for a line of a CityJSONSeq, whose header has the transform.
int spare_digits(const Document& document);

/// `building`, one of the document, as it is read again after `solid` was written in the place of
/// its polygons: one polygon for each facet (Polygon::source is its number), vertices rounded to
/// the transform's scale, which is finer by `digits` powers of ten. Repeated vertices are kept: it
/// is what a validator gets to see.
Building as_written(const Document& document, const Building& building, const Solid& solid,
                    int digits);

}  // namespace oriel
