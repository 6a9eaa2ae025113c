#pragma once

#include "io/gpkg/database.h"
#include "io/gpkg/gpkg_columns.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace oriel::detail {

/// A row of gpkg_spatial_ref_sys.
struct ReferenceSystem {
  /// -1: undefined, in metres.
  std::int32_t number = -1;
  std::string name;
  std::string organization;
};

/// The reference system that a CityJSON file names: an EPSG code under its number; anything else by
/// its text, under a number of no organization.
ReferenceSystem reference_system(std::string_view crs);

/// "buildings", "surfaces", "features".
std::string table_name(GpkgTable table);

/// The columns that a table always has.
GpkgColumns table_columns(GpkgTable table);

/// Makes the tables that a GeoPackage has to have, and puts the reference system into them.
void make_gpkg(Database& database, const ReferenceSystem& system);

/// Makes a table of features and enters it, its geometry and its columns. The columns are settled.
void make_table(Database& database, GpkgTable table, const GpkgColumns& columns,
                const ReferenceSystem& system);

/// Makes the spatial index of a table; false where SQLite has no R-trees.
bool make_index(Database& database, GpkgTable table);
/// Lets it follow when the table is edited: after the last row.
void make_triggers(Database& database, GpkgTable table);

}  // namespace oriel::detail
