#include "io/gpkg/gpkg_schema.h"

#include "io/files/proj_pointers.h"
#include "model/description/attributes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// What defines a reference system in a GeoPackage: its well-known text (OGC 01-009) on one line,
/// as PROJ knows the system by its organization and number; "undefined" where PROJ does not know
/// it. Source: OGC 12-128r18, table 3.
std::string crs_definition(const std::string& organization, int number) {
  const PjContextPointer context(proj_context_create());
  if (!context) return "undefined";
  proj_log_level(context.get(), PJ_LOG_NONE);
  const PjPointer crs(proj_create_from_database(context.get(), organization.c_str(),
                                                std::to_string(number).c_str(), PJ_CATEGORY_CRS, 0,
                                                nullptr));
  if (!crs) return "undefined";
  constexpr std::array<const char*, 2> kOptions{"MULTILINE=NO", nullptr};
  const char* text = proj_as_wkt(context.get(), crs.get(), PJ_WKT1_GDAL, kOptions.data());
  return text == nullptr ? "undefined" : text;
}

/// When all tables were changed: the same bytes whenever the file is made.
constexpr const char* kTime = "1970-01-01T00:00:00.000Z";
/// The first number of those that nobody has given away.
constexpr std::int32_t kFirstFree = 100'000;

/// GeoPackage 1.3, annex C, and its extension for schemas (F.9).
constexpr const char* kTables = R"(
CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT NOT NULL, srs_id INTEGER PRIMARY KEY, organization TEXT NOT NULL, organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
CREATE TABLE gpkg_contents (table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE, description TEXT DEFAULT '', last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')), min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER, CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT NOT NULL, srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL, CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name), CONSTRAINT uk_gc_table_name UNIQUE (table_name), CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents(table_name), CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_extensions (table_name TEXT, column_name TEXT, extension_name TEXT NOT NULL, definition TEXT NOT NULL, scope TEXT NOT NULL, CONSTRAINT ge_tce UNIQUE (table_name, column_name, extension_name));
CREATE TABLE gpkg_data_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, name TEXT, title TEXT, description TEXT, mime_type TEXT, constraint_name TEXT, CONSTRAINT pk_gdc PRIMARY KEY (table_name, column_name), CONSTRAINT gdc_tn UNIQUE (table_name, name));
CREATE TABLE gpkg_data_column_constraints (constraint_name TEXT NOT NULL, constraint_type TEXT NOT NULL, value TEXT, min NUMERIC, min_is_inclusive BOOLEAN, max NUMERIC, max_is_inclusive BOOLEAN, description TEXT, CONSTRAINT gdcc_ntv UNIQUE (constraint_name, constraint_type, value));
INSERT INTO gpkg_extensions VALUES ('gpkg_data_columns', NULL, 'gpkg_schema', 'http://www.geopackage.org/spec130/#extension_schema', 'read-write'), ('gpkg_data_column_constraints', NULL, 'gpkg_schema', 'http://www.geopackage.org/spec130/#extension_schema', 'read-write');
INSERT INTO gpkg_spatial_ref_sys VALUES ('Undefined Cartesian SRS', -1, 'NONE', -1, 'undefined', 'undefined Cartesian coordinate reference system'), ('Undefined geographic SRS', 0, 'NONE', 0, 'undefined', 'undefined geographic coordinate reference system'), ('WGS 84 geodetic', 4326, 'EPSG', 4326, 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AXIS["Latitude",NORTH],AXIS["Longitude",EAST],AUTHORITY["EPSG","4326"]]', 'longitude/latitude coordinates in decimal degrees on the WGS 84 spheroid');
)";

/// GeoPackage 1.3, F.3; {0} is the table, {1} its index.
constexpr const char* kTriggers = R"(
CREATE TRIGGER "{1}_insert" AFTER INSERT ON "{0}" WHEN (new."geom" NOT NULL AND NOT ST_IsEmpty(NEW."geom")) BEGIN INSERT OR REPLACE INTO "{1}" VALUES (NEW."fid", ST_MinX(NEW."geom"), ST_MaxX(NEW."geom"), ST_MinY(NEW."geom"), ST_MaxY(NEW."geom")); END;
CREATE TRIGGER "{1}_update1" AFTER UPDATE OF "geom" ON "{0}" WHEN OLD."fid" = NEW."fid" AND (NEW."geom" NOTNULL AND NOT ST_IsEmpty(NEW."geom")) BEGIN INSERT OR REPLACE INTO "{1}" VALUES (NEW."fid", ST_MinX(NEW."geom"), ST_MaxX(NEW."geom"), ST_MinY(NEW."geom"), ST_MaxY(NEW."geom")); END;
CREATE TRIGGER "{1}_update2" AFTER UPDATE OF "geom" ON "{0}" WHEN OLD."fid" = NEW."fid" AND (NEW."geom" ISNULL OR ST_IsEmpty(NEW."geom")) BEGIN DELETE FROM "{1}" WHERE id = OLD."fid"; END;
CREATE TRIGGER "{1}_update3" AFTER UPDATE ON "{0}" WHEN OLD."fid" != NEW."fid" AND (NEW."geom" NOTNULL AND NOT ST_IsEmpty(NEW."geom")) BEGIN DELETE FROM "{1}" WHERE id = OLD."fid"; INSERT OR REPLACE INTO "{1}" VALUES (NEW."fid", ST_MinX(NEW."geom"), ST_MaxX(NEW."geom"), ST_MinY(NEW."geom"), ST_MaxY(NEW."geom")); END;
CREATE TRIGGER "{1}_update4" AFTER UPDATE ON "{0}" WHEN OLD."fid" != NEW."fid" AND (NEW."geom" ISNULL OR ST_IsEmpty(NEW."geom")) BEGIN DELETE FROM "{1}" WHERE id IN (OLD."fid", NEW."fid"); END;
CREATE TRIGGER "{1}_delete" AFTER DELETE ON "{0}" WHEN old."geom" NOT NULL BEGIN DELETE FROM "{1}" WHERE id = OLD."fid"; END;
)";

struct ColumnMeaning {
  std::string_view column;
  std::string_view meaning;
};

constexpr std::array<ColumnMeaning, 17> kMeanings{
    {{"area_m2", "area of the surface in square metres"},
     {"building", "id of the building or building part, as in the file of buildings"},
     {"host", "id of the feature that it stands on or lies in; none: the building's body"},
     {"id", "id of the feature; of a surface, that of the feature that it belongs to"},
     {"label", "what the rules say that it is"},
     {"lod", "level of detail of the geometry"},
     {"margin", "how far its score is above that of the next best label"},
     {"name", "what a person would call it"},
     {"parent", "fid of the surface that the opening lies in"},
     {"part_of", "id of the object that it is a part of"},
     {"rule", "the rule that gave the label"},
     {"runner_up", "the next best label"},
     {"score", "how well the rule holds, from 0 to 1"},
     {"surface", "type of the semantic surface"},
     {"type", "type of the object"},
     {"written_as", "type of the surfaces or the object that stand for the feature"},
     {kRestColumn, "attributes beyond the columns that a table can have, as JSON"}}};

std::string_view unit_words(Unit unit) {
  switch (unit) {
    case Unit::metre:
      return ", in metres";
    case Unit::square_metre:
      return ", in square metres";
    case Unit::cubic_metre:
      return ", in cubic metres";
    case Unit::degree:
      return ", in degrees";
    default:
      return "";
  }
}

/// What a column holds, or nothing where the input alone knows.
std::string meaning_of_column(const GpkgColumn& column) {
  if (column.role == GpkgRole::count)
    return "number of features with the label " + column.name.substr(column.name.find('_') + 1);
  if (column.role != GpkgRole::attribute)
    for (const auto& [name, meaning] : kMeanings)
      if (name == column.name) return std::string(meaning);
  if (column.role == GpkgRole::fixed)
    for (const AttributeInfo& info : feature_schema())
      if (record_name(info) == column.name)
        return info.meaning + std::string(unit_words(info.unit));
  return column.table_name == column.name ? "" : "the attribute '" + column.name + "'";
}

std::string index_name(GpkgTable table) { return "rtree_" + table_name(table) + "_geom"; }

std::string_view description_of(GpkgTable table) {
  switch (table) {
    case GpkgTable::buildings:
      return "buildings and their parts, with the number of features of each label";
    case GpkgTable::surfaces:
      return "semantic surfaces of the buildings";
    case GpkgTable::features:
      return "labelled features of the buildings";
  }
  return "";
}

}  // namespace

ReferenceSystem reference_system(std::string_view crs) {
  if (crs.empty()) return {};
  const std::string_view code = crs.substr(crs.find_last_of(":/") + 1);
  std::int32_t number = 0;
  const auto [end, error] = std::from_chars(code.data(), code.data() + code.size(), number);
  const bool is_number = error == std::errc() && end == code.data() + code.size() && number > 0;
  if (is_number && crs.find("EPSG") != std::string_view::npos)
    return {number, "EPSG:" + std::string(code), "EPSG"};
  return {kFirstFree, std::string(crs), "NONE"};
}

std::string table_name(GpkgTable table) {
  switch (table) {
    case GpkgTable::buildings:
      return "buildings";
    case GpkgTable::surfaces:
      return "surfaces";
    case GpkgTable::features:
      return "features";
  }
  return "";
}

GpkgColumns table_columns(GpkgTable table) {
  GpkgColumns columns;
  const auto declare_texts = [&](std::initializer_list<const char*> names) {
    for (const char* name : names) columns.declare(name, ColumnType::text);
  };
  declare_texts({"building"});
  if (table == GpkgTable::buildings) {
    declare_texts({"type", "part_of", "lod"});
    return columns;
  }
  if (table == GpkgTable::surfaces) {
    declare_texts({"surface"});
    columns.declare("parent", ColumnType::integer, GpkgRole::row);
    declare_texts({"id"});
  } else {
    declare_texts({"id", "written_as"});
  }
  declare_texts({"label", "name"});
  columns.declare("score", ColumnType::real);
  declare_texts({"rule"});
  if (table == GpkgTable::surfaces) columns.declare("area_m2", ColumnType::real);
  return columns;
}

void make_gpkg(Database& database, const ReferenceSystem& system) {
  // "GPKG" and 1.3.0.
  database.run("PRAGMA application_id = 1196444487; PRAGMA user_version = 10300; BEGIN;");
  database.run(kTables);
  if (system.number == -1 || system.number == 4326) return;
  database.run(
      fmt::format("INSERT INTO gpkg_spatial_ref_sys VALUES ({0}, {1}, {2}, {1}, "
                  "{3}, {4})",
                  quoted_text(system.name), system.number, quoted_text(system.organization),
                  quoted_text(crs_definition(system.organization, system.number)),
                  quoted_text("as the file of buildings names it")));
}

void make_table(Database& database, GpkgTable table, const GpkgColumns& columns,
                const ReferenceSystem& system) {
  const std::string name = table_name(table);
  std::string sql = fmt::format(
      "CREATE TABLE {} (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom MULTIPOLYGON",
      quoted_name(name));
  for (const GpkgColumn& column : columns.columns())
    sql += ", " + quoted_name(column.table_name) + ' ' + type_name(column.type);
  if (columns.has_rest()) sql += fmt::format(", {} TEXT", kRestColumn);
  database.run(sql + ")");
  const Box box = columns.box();
  const std::string extent =
      box.is_empty() ? "NULL, NULL, NULL, NULL"
                     : fmt::format("{}, {}, {}, {}", box.min.x, box.min.y, box.max.x, box.max.y);
  database.run(
      fmt::format("INSERT INTO gpkg_contents VALUES ('{0}', 'features', '{0}', '{1}', "
                  "'{2}', {3}, {4})",
                  name, description_of(table), kTime, extent, system.number));
  database.run(fmt::format(
      "INSERT INTO gpkg_geometry_columns VALUES ('{}', 'geom', 'MULTIPOLYGON', {}, 1, 0)", name,
      system.number));
  Database::Statement insert(
      database, "INSERT INTO gpkg_data_columns VALUES (?, ?, NULL, NULL, ?, NULL, NULL)");
  const auto describe = [&](const std::string& column, const std::string& meaning) {
    if (meaning.empty()) return;
    const GpkgValue in = name, of = column, says = meaning;
    insert.set(1, in);
    insert.set(2, of);
    insert.set(3, says);
    insert.run();
  };
  for (const GpkgColumn& column : columns.columns())
    describe(column.table_name, meaning_of_column(column));
  if (columns.has_rest()) describe(kRestColumn, std::string(kMeanings.back().meaning));
}

bool make_index(Database& database, GpkgTable table) {
  return database.may_run(
      fmt::format("CREATE VIRTUAL TABLE {} USING rtree(id, minx, maxx, miny, maxy)",
                  quoted_name(index_name(table))));
}

void make_triggers(Database& database, GpkgTable table) {
  database.run(fmt::format(fmt::runtime(kTriggers), table_name(table), index_name(table)));
  database.run(
      fmt::format("INSERT INTO gpkg_extensions VALUES ('{}', 'geom', 'gpkg_rtree_index', "
                  "'http://www.geopackage.org/spec130/#extension_rtree', 'write-only')",
                  table_name(table)));
}

}  // namespace oriel::detail
