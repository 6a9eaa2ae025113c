#pragma once

#include "io/gpkg/gpkg_row.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace oriel::detail {

/// The type of a column; those of its values come together in it: whole numbers and others are
/// real, other mixtures are text.
enum class ColumnType : std::uint8_t { none, boolean, integer, real, text };

struct GpkgColumn {
  /// As the cells call it.
  std::string name;
  GpkgRole role = GpkgRole::fixed;
  ColumnType type = ColumnType::none;
  /// Its values are of types that only text can hold together.
  bool is_mixed = false;
  /// In the table: unlike all others there, whatever the case of letters.
  std::string table_name{};
};

/// The columns of a table as its rows turn up.
class GpkgColumns {
 public:
  /// Most that the table has itself; what is beyond goes to one column more, as JSON (SQLite has
  /// 2,000 at most).
  static constexpr std::size_t kMost = 1'900;

  /// A column that the table has whether a row has it or not.
  void declare(std::string name, ColumnType type, GpkgRole role = GpkgRole::fixed);
  /// Notes the columns of a row and the types of its values.
  void note(const GpkgRow& row);
  /// No row is to come: puts the columns in order, fixed ones first, then attributes, counts last,
  /// and gives them their names in the table.
  void settle();

  [[nodiscard]] const std::vector<GpkgColumn>& columns() const { return columns_; }
  [[nodiscard]] bool has_rest() const { return has_rest_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] const Box& box() const { return box_; }

  /// What stands in the table for the cells of a row, one value for each column; `row` is its
  /// number there. With has_rest() one more.
  [[nodiscard]] std::vector<GpkgValue> values(const GpkgRow& row, std::int64_t number) const;

 private:
  using Key = std::pair<GpkgRole, std::string>;

  std::vector<GpkgColumn> columns_;
  std::map<Key, std::size_t> place_of_;
  bool has_rest_ = false;
  std::size_t rows_ = 0;
  Box box_;
};

/// The name of the column for what is beyond kMost.
inline constexpr const char* kRestColumn = "further_attributes";

/// "INTEGER" …; of a column without values TEXT.
std::string type_name(ColumnType type);

}  // namespace oriel::detail
