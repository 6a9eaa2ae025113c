#include "model/description/surface_table.h"

#include <limits>

namespace oriel {

SurfaceTable::SurfaceTable(std::size_t rows) : rows_(rows), columns_(kSurfaceAttributes.size()) {
  for (const SurfaceAttribute attribute : kSurfaceAttributes) {
    Column& column = columns_[column_of(attribute)];
    if (info_of(attribute).unit == Unit::text)
      column.texts = WordColumn(rows);
    else
      column.numbers.resize(rows, std::numeric_limits<double>::quiet_NaN());
  }
}

}  // namespace oriel
