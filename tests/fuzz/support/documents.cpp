#include "tests/fuzz/support/documents.h"

#include "io/citygml/write/citygml_writer.h"
#include "io/gpkg/gpkg_row.h"
#include "io/gpkg/gpkg_rows.h"
#include "io/mesh/mesh_writer.h"
#include "io/reader.h"
#include "io/writer.h"
#include "tests/fuzz/targets.h"

#include <string>
#include <vector>

namespace oriel::fuzz {

namespace {

/// More polygons than that are not written: labels make texts longer than what was read.
constexpr std::size_t kMostPolygonsRead = 500;

LabelledBuilding with_labels(const Building& building) {
  LabelledBuilding labelled;
  labelled.building = building.id;
  labelled.surfaces = {{"WallSurface", -1, {}}, {"Window", 0, FeatureLabel{.id = "w"}}};
  labelled.surface_of_polygon.assign(building.polygons.size(), 1);
  labelled.installations = {{"i", FeatureLabel{.class_code = "1000"}, {0}, {1}}};
  return labelled;
}

/// Ids may stand twice in a file; only the first of them can be labelled.
std::vector<LabelledBuilding> labels_of(const Document& document) {
  std::vector<LabelledBuilding> labelled;
  for (const Building& building : document.buildings)
    if (!building.polygons.empty()) labelled.push_back(with_labels(building));
  return labelled;
}

void write_meshes(const Document& document, const std::vector<LabelledBuilding>& labelled) {
  MeshSource mesh;
  append_mesh(mesh, document, labelled);
  (void)write_obj(mesh);
  (void)write_off(mesh);
  (void)write_ply(mesh);
  (void)write_stl(mesh);
}

bool is_small(const Document& document) {
  std::size_t polygons = 0;
  for (const Building& building : document.buildings) polygons += building.polygons.size();
  return polygons <= kMostPolygonsRead;
}

/// Of one whole file: lines of a stream need their header.
void check_emitted(const std::string& text, std::size_t buildings) {
  static const ScratchFile again("again.city.json");
  Reader reader(again.write(text), {});
  const auto record = reader.next();
  promise(record && record->value, "what was written can be read",
          record && !record->issues.empty() ? to_string(record->issues.front()) : "");
  promise(record->value->buildings.size() == buildings, "all buildings are read again");
  const std::string same = write_cityjson(*record->value, labels_of(*record->value));
  promise(same == text, "what was read again is written as the same bytes");
}

/// A whole file as CityGML is XML that can be read; its rows come back whole.
void check_other_formats(const Document& document, const std::string& text) {
  static const ScratchFile gml("again.gml");
  for (const Format format : {Format::citygml2, Format::citygml3}) {
    std::vector<Issue> issues;
    const std::string written = citygml_text(text, document, format, true, issues);
    Reader reader(gml.write(written + citygml_end()), {});
    while (const auto record = reader.next())
      promise(record->value.has_value(), "CityGML that was written can be read",
              record->issues.empty() ? "" : to_string(record->issues.front()));
  }
  const std::string rows = gpkg_rows(text, document, {});
  promise(detail::for_each_row(rows, [](const detail::GpkgRow&) {}) == rows.size(),
          "rows of a GeoPackage are whole");
}

void write(const Document& document) {
  if (!is_small(document)) return;
  // Of a CityGML building that could not be read nothing is written.
  if (document.format == Format::citygml && !document.source) return;
  const std::vector<LabelledBuilding> labelled = labels_of(document);
  const std::string text = write_cityjson(document, labelled, {});
  promise(!text.empty(), "a record that was read can be written");
  const bool is_file = document.format == Format::cityjson || is_mesh(document.format);
  if (is_file) check_emitted(text, document.buildings.size());
  if (is_file) check_other_formats(document, text);
  write_meshes(document, labelled);
}

}  // namespace

void read_and_write(const ScratchFile& file, Format format, std::string_view bytes) {
  ReadOptions options;
  options.format = format;
  options.wants_sha256 = true;
  try {
    Reader reader(file.write(bytes), options);
    while (const auto record = reader.next()) {
      promise(record->value.has_value() || has_errors(record->issues),
              "a record has a value or an error");
      for (const Issue& issue : record->issues) (void)to_string(issue);
      if (record->value) write(*record->value);
    }
    (void)reader.sha256();
  } catch (const InputError& error) {
    (void)to_string(error.issue());
  }
}

}  // namespace oriel::fuzz
