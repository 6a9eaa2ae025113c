#pragma once

#include "model/vec3.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace oriel::detail {

/// The tables of features.
enum class GpkgTable : std::uint8_t { buildings, surfaces, features };
inline constexpr std::size_t kGpkgTables = 3;

/// What a value of a row is for: a column of its table's own, an attribute of the input, a count of
/// features (0 in rows that do not have it), or the number of another row less that of this one.
enum class GpkgRole : std::uint8_t { fixed, attribute, count, row };

using GpkgValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct GpkgCell {
  std::string column;
  GpkgRole role = GpkgRole::fixed;
  GpkgValue value;
};

/// A row of one of the tables.
struct GpkgRow {
  GpkgTable table = GpkgTable::buildings;
  /// The geometry as GeoPackage stores it without the number of its reference system; empty: none.
  std::string geometry;
  Box box;
  std::vector<GpkgCell> cells;
};

/// Appends the row as bytes, which only for_each_row() reads.
void append_row(std::string& bytes, const GpkgRow& row);

/// Calls `visit` with each of the rows in `bytes` and returns how many bytes they take: a row that
/// is not there whole is left.
std::size_t for_each_row(std::string_view bytes, const std::function<void(GpkgRow)>& visit);

}  // namespace oriel::detail
