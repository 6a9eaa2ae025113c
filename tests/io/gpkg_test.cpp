#include "io/gpkg/gpkg_rows.h"
#include "io/gpkg/gpkg_writer.h"
#include "io/writer.h"
#include "tests/io/cityjson_samples.h"
#include "tests/io/files.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sqlite3.h>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel {
namespace {

using namespace test;

/// A GeoPackage that is read by SQLite.
class OpenedPackage {
 public:
  explicit OpenedPackage(const std::string& path) {
    REQUIRE(sqlite3_open_v2(path.c_str(), &handle_, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK);
  }
  ~OpenedPackage() { sqlite3_close(handle_); }
  OpenedPackage(const OpenedPackage&) = delete;
  OpenedPackage& operator=(const OpenedPackage&) = delete;

  /// The cells of all rows, `|` between cells, a blank between rows.
  [[nodiscard]] std::string ask(const std::string& sql) const {
    sqlite3_stmt* statement = nullptr;
    CAPTURE(sql);
    REQUIRE(sqlite3_prepare_v2(handle_, sql.c_str(), -1, &statement, nullptr) == SQLITE_OK);
    std::string rows;
    while (sqlite3_step(statement) == SQLITE_ROW) {
      if (!rows.empty()) rows += ' ';
      for (int i = 0; i < sqlite3_column_count(statement); ++i) {
        if (i > 0) rows += '|';
        const int size = sqlite3_column_bytes(statement, i);
        const void* cell = sqlite3_column_blob(statement, i);
        if (cell != nullptr)
          rows.append(static_cast<const char*>(cell), static_cast<std::size_t>(size));
      }
    }
    sqlite3_finalize(statement);
    return rows;
  }

 private:
  sqlite3* handle_ = nullptr;
};

struct WrittenPackage {
  std::string path;
  std::string bytes;
  std::string codes;
};

/// The records of a file as a GeoPackage.
WrittenPackage package_of(const TemporaryFolder& folder, const std::string& text,
                          const std::string& name = "a.city.json") {
  WrittenPackage written{folder.file("a.gpkg"), "", ""};
  GpkgWriter writer(written.path);
  for (const auto& record : read_all(folder.write(name, text))) {
    REQUIRE(record.value);
    const Document& document = *record.value;
    const std::string crs = document.buildings.empty() ? "" : document.buildings[0].frame.crs;
    writer.take(gpkg_rows(write_cityjson(document, {}), document, {}), crs);
  }
  OutputFile file(written.path);
  written.codes = codes_of(writer.end(file));
  file.commit();
  written.bytes = text_of(written.path);
  return written;
}

BoxFile box_with_features() {
  BoxFile box;
  box.geometry =
      R"(,"semantics":{"surfaces":[{"type":"WallSurface"},{"type":"Window","parent":0,"oriel_id":"f1","oriel_label":"window","oriel_score":1,"oriel_rule":"w"},{"type":"Window","parent":0,"oriel_id":"f2","oriel_label":"window","oriel_score":0.5,"oriel_rule":"w"},{"type":"RoofSurface"}],"values":[[null,3,0,1,1,2]]})";
  box.building =
      R"(,"attributes":{"Year":1990,"year":"old","fid":7,"a \"b\"; DROP TABLE":true},"children":["dormer"])";
  box.objects =
      R"(,"dormer":{"type":"BuildingInstallation","attributes":{"function":"1070","oriel_label":"dormer"},"parents":["house"],"geometry":[{"type":"MultiSurface","lod":"2.2","boundaries":[[[0,1,5,4]]]}]})";
  box.root = R"(,"metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/25832"})";
  return box;
}

/// Several buildings whose attribute has these values.
std::string with_values(const std::vector<std::string>& values) {
  std::string objects;
  for (std::size_t i = 0; i < values.size(); ++i)
    objects += fmt::format(
        R"({}"b{}":{{"type":"Building","attributes":{{"a":{}}},"geometry":[{{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}}]}})",
        i == 0 ? "" : ",", i, values[i]);
  return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{)" +
         objects + R"(},"vertices":[[0,0,0],[1,0,0],[0,1,0]]})";
}

TEST_SUITE("io") {
  TEST_CASE("a GeoPackage has a row for each building and surface and feature") {
    const TemporaryFolder folder;
    const WrittenPackage written = package_of(folder, box_with_features().text());
    CHECK(written.codes.empty());
    const OpenedPackage package(written.path);
    CHECK(package.ask("PRAGMA integrity_check") == "ok");
    CHECK(package.ask("PRAGMA application_id") == "1196444487");
    CHECK(package.ask("PRAGMA user_version") == "10300");
    CHECK(package.ask("SELECT table_name, srs_id, min_x, max_y FROM gpkg_contents") ==
          "buildings|25832|1000.5|2003.25 surfaces|25832|1000.5|2003.25 "
          "features|25832|1000.5|2003.25");
    CHECK(package.ask("SELECT organization, organization_coordsys_id FROM gpkg_spatial_ref_sys "
                      "WHERE srs_id = 25832") == "EPSG|25832");
    CHECK(package.ask("SELECT definition FROM gpkg_spatial_ref_sys WHERE srs_id = 25832")
              .starts_with("PROJCS[\"ETRS89 / UTM zone 32N\",GEOGCS["));
    CHECK(package.ask("SELECT building, type, lod, count_window, count_dormer FROM buildings") ==
          "house|Building|2.2|2|1");
    CHECK(package.ask("SELECT fid, surface, parent, id, score, area_m2 FROM surfaces") ==
          "1|WallSurface||||8.0 2|Window|1|f1|1.0|14.0 3|Window|1|f2|0.5|6.0 "
          "4|RoofSurface||||12.0");
    CHECK(package.ask("SELECT id, building, written_as, label, rule, function FROM features") ==
          "f1|house|Window|window|w| f2|house|Window|window|w| "
          "dormer|house|BuildingInstallation|dormer||1070");
  }

  TEST_CASE("the spatial index has the box of every row with a geometry") {
    const TemporaryFolder folder;
    const OpenedPackage package(package_of(folder, box_with_features().text()).path);
    CHECK(package.ask("SELECT count(*) FROM rtree_surfaces_geom") == "4");
    CHECK(package.ask("SELECT id, minx, maxx, miny, maxy FROM rtree_buildings_geom") ==
          "1|1000.5|1004.5|2000.25|2003.25");
    CHECK(package.ask("SELECT count(*) FROM gpkg_extensions WHERE extension_name = "
                      "'gpkg_rtree_index'") == "3");
    CHECK(package.ask("SELECT count(*) FROM sqlite_master WHERE type = 'trigger'") == "18");
  }

  TEST_CASE("a geometry is a MultiPolygon Z of the polygons with closed rings") {
    const TemporaryFolder folder;
    const OpenedPackage package(package_of(folder, box_with_features().text()).path);
    const std::string blob = package.ask("SELECT geom FROM surfaces WHERE fid = 4");
    REQUIRE(blob.size() == 8 + 48 + 9 + 9 + 4 + 5 * 24);
    CHECK(blob.substr(0, 2) == "GP");
    std::int32_t srs = 0;
    std::uint32_t type = 0, points = 0;
    double first = 0, last = 0;
    std::memcpy(&srs, blob.data() + 4, 4);
    std::memcpy(&type, blob.data() + 57, 4);
    std::memcpy(&points, blob.data() + 74, 4);
    std::memcpy(&first, blob.data() + 78, 8);
    std::memcpy(&last, blob.data() + 78 + 4 * 24, 8);
    CHECK(srs == 25832);
    CHECK(type == 1006);
    CHECK(points == 5);
    CHECK(first == 1000.5);
    CHECK(last == first);
  }

  TEST_CASE("a window that only the dormer around it names is a feature, once") {
    BoxFile box = box_with_features();
    const std::string dormer = R"("boundaries":[[[0,1,5,4]]])";
    box.objects.replace(
        box.objects.find(dormer), dormer.size(),
        R"("boundaries":[[[0,1,5,4]],[[1,2,6,5]]],"semantics":{"surfaces":[{"type":"Window","oriel_id":"f1","oriel_label":"window"},{"type":"Window","oriel_id":"f3","oriel_label":"window"}],"values":[0,1]})");
    const TemporaryFolder folder;
    const OpenedPackage package(package_of(folder, box.text()).path);
    CHECK(package.ask("SELECT count_window FROM buildings") == "3");
    CHECK(package.ask("SELECT id FROM features") == "f1 f2 dormer f3");
    // Polygons of the one that the building has, too, are not there twice.
    CHECK(package.ask("SELECT length(geom) FROM features WHERE id = 'f1'") ==
          package.ask("SELECT length(geom) FROM surfaces WHERE id = 'f1'"));
  }

  TEST_CASE("polygons of fewer than three corners are in no geometry") {
    BoxFile box;
    box.objects =
        R"(,"line":{"type":"BuildingInstallation","parents":["house"],"geometry":[{"type":"MultiSurface","lod":"2.2","boundaries":[[[0,1]],[[0,1,0,1]]]}]},"face":{"type":"BuildingInstallation","parents":["house"],"geometry":[{"type":"MultiSurface","lod":"2.2","boundaries":[[[0,1]],[[0,1,5],[1,5]]]}]})";
    box.building = R"(,"children":["line","face"])";
    const TemporaryFolder folder;
    const OpenedPackage package(package_of(folder, box.text()).path);
    CHECK(package.ask("SELECT id, length(geom) FROM features ORDER BY id") ==
          fmt::format("face|{} line|", 8 + 48 + 9 + 9 + 4 + 4 * 24));
  }

  TEST_CASE("GDAL counts the rows of each layer as SQLite does") {
    if (std::system("command -v ogrinfo >/dev/null") != 0) {
      MESSAGE("skipped: no ogrinfo (apt-get install gdal-bin)");
      return;
    }
    const TemporaryFolder folder;
    const std::string path = package_of(folder, box_with_features().text()).path;
    const std::string said = folder.file("said.txt");
    REQUIRE(std::system(("ogrinfo -ro -al " + path + " >" + said + " 2>&1").c_str()) == 0);
    const std::string text = text_of(said);
    CHECK(text.find("ERROR") == std::string::npos);
    CHECK(text.find("Warning") == std::string::npos);
    const OpenedPackage package(path);
    for (const std::string layer : {"buildings", "surfaces", "features"}) {
      const std::size_t begin = text.find("Layer name: " + layer + "\n");
      REQUIRE(begin != std::string::npos);
      const std::string of_layer = text.substr(begin, text.find("Layer name: ", begin + 1) - begin);
      const std::string rows = package.ask("SELECT count(*) FROM " + layer);
      CHECK(of_layer.find("Geometry: 3D Multi Polygon\n") != std::string::npos);
      CHECK(of_layer.find("Feature Count: " + rows + "\n") != std::string::npos);
      std::size_t shown = 0;
      for (std::size_t at = 0; (at = of_layer.find("OGRFeature(", at)) != std::string::npos; ++at)
        ++shown;
      CHECK(std::to_string(shown) == rows);
    }
  }

  TEST_CASE("the tables of a package are joined by the ids of building and feature") {
    const TemporaryFolder folder;
    const OpenedPackage package(package_of(folder, box_with_features().text()).path);
    CHECK(package.ask("SELECT DISTINCT type, surface, f.id FROM buildings JOIN features f USING "
                      "(building) JOIN surfaces USING (building, id)") ==
          "Building|Window|f1 Building|Window|f2");
  }

  TEST_CASE("columns have names of their own whatever the attributes are called") {
    const TemporaryFolder folder;
    const OpenedPackage package(package_of(folder, box_with_features().text()).path);
    CHECK(package.ask("SELECT \"Year\", \"year_2\", \"fid_2\", \"a \"\"b\"\"; DROP TABLE\" FROM "
                      "buildings") == "1990|old|7|1");
    CHECK(package.ask("SELECT name, type FROM pragma_table_info('buildings') WHERE cid > 5 AND cid "
                      "< 10") ==
          "Year|INTEGER year_2|TEXT fid_2|INTEGER a \"b\"; DROP TABLE|BOOLEAN");
    CHECK(package.ask("SELECT description FROM gpkg_data_columns WHERE column_name = 'year_2'") ==
          "the attribute 'year'");
    CHECK(package.ask("SELECT description FROM gpkg_data_columns WHERE table_name = 'surfaces' AND "
                      "column_name = 'area_m2'") == "area of the surface in square metres");
  }

  TEST_CASE("no column is called as a reader calls the geometry") {
    const TemporaryFolder folder;
    BoxFile box;
    box.building = R"(,"attributes":{"Geometry":"lod2","geom":1,"geometry":"b"})";
    const OpenedPackage package(package_of(folder, box.text()).path);
    CHECK(package.ask("SELECT \"Geometry_2\", \"geom_2\", \"geometry_3\" FROM buildings") ==
          "lod2|1|b");
  }

  TEST_CASE("a column has the type that all values have and is text with a warning otherwise") {
    struct Case {
      std::vector<std::string> values;
      const char* type;
      const char* found;
      const char* codes;
    };
    for (const Case& c : {Case{{"1", "2"}, "INTEGER", "1 2", ""},
                          {{"1", "2.5", "null"}, "REAL", "1.0 2.5 ", ""},
                          {{"true", "false"}, "BOOLEAN", "1 0", ""},
                          {{"true", "2"}, "TEXT", "true 2", "E165"},
                          {{"1", R"("x")", "0.5"}, "TEXT", "1 x 0.5", "E165"},
                          {{"[1,2]", R"({"b":null})"}, "TEXT", "[1,2] {\"b\":null}", ""}}) {
      const TemporaryFolder folder;
      const WrittenPackage written = package_of(folder, with_values(c.values));
      CHECK(written.codes == c.codes);
      const OpenedPackage package(written.path);
      CHECK(package.ask("SELECT type FROM pragma_table_info('buildings') WHERE name = 'a'") ==
            c.type);
      CHECK(package.ask("SELECT a FROM buildings") == c.found);
    }
  }

  TEST_CASE("texts of any length and with NUL are kept as far as SQLite can") {
    const TemporaryFolder folder;
    const std::string longest(3'000'000, 'x');
    const OpenedPackage package(
        package_of(folder, with_values({'"' + longest + '"', R"("a\u0000b")"})).path);
    CHECK(package.ask("SELECT length(a) FROM buildings") == "3000000 3");
  }

  TEST_CASE("what is beyond the columns that SQLite has goes to one column") {
    nlohmann::json city = nlohmann::json::parse(BoxFile().text());
    for (int i = 0; i < 2100; ++i)
      city["CityObjects"]["house"]["attributes"][fmt::format("a{:04}", i)] = i;
    const TemporaryFolder folder;
    const OpenedPackage package(package_of(folder, city.dump()).path);
    CHECK(package.ask("SELECT a0000, further_attributes LIKE '%\"a2099\":2099}' FROM buildings") ==
          "0|1");
  }

  TEST_CASE("without a reference system the coordinates are undefined ones in a plane") {
    const TemporaryFolder folder;
    const OpenedPackage package(package_of(folder, BoxFile().text()).path);
    CHECK(package.ask("SELECT srs_id FROM gpkg_geometry_columns WHERE table_name = 'buildings'") ==
          "-1");
  }

  TEST_CASE("the same input gives the same bytes and nothing else is left") {
    const TemporaryFolder folder, other;
    const std::string bytes = package_of(folder, box_with_features().text()).bytes;
    CHECK(bytes == package_of(other, box_with_features().text()).bytes);
    CHECK(folder.file_count() == 2);
  }

  TEST_CASE("a GeoPackage of no buildings has empty tables") {
    const TemporaryFolder folder;
    const WrittenPackage written{folder.file("a.gpkg"), "", ""};
    GpkgWriter writer(written.path);
    OutputFile file(written.path);
    CHECK(writer.end(file).empty());
    file.commit();
    const OpenedPackage package(written.path);
    CHECK(package.ask("SELECT count(*) FROM buildings") == "0");
    CHECK(package.ask("SELECT min_x FROM gpkg_contents").find_first_not_of(' ') ==
          std::string::npos);
  }
}

}  // namespace
}  // namespace oriel
