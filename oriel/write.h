#pragma once

#include "io/document.h"
#include "io/files/format.h"
#include "io/files/output_file.h"
#include "io/mesh/mesh_writer.h"
#include "io/records/feature_records.h"
#include "io/writer.h"
#include "model/labelled_building.h"
#include "oriel/result.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

class CityJsonCollector;
class GpkgWriter;

/// What is to be written of one record.
struct OutputRecord {
  std::vector<LabelledBuilding> buildings;
  WriteOptions options{};
  /// Of the buildings' features, from feature_records(): a GeoPackage has their attributes. Other
  /// formats do not have them.
  std::vector<FeatureRecord> features{};
};

/// Adds a building, such as PipelineResult::output or Repaired::output. One without id, of which
/// nothing could be made, is passed over: it is written unchanged.
void add(LabelledBuilding building, OutputRecord& output);

/// A record as CityJSON with its labels: the text of a file, or of a CityJSONSeq one line with its
/// line end. What the labels do not concern stays byte for byte; write_cityjson() in
/// io/writer.h says what becomes of the rest.
std::string write(const Document& document, const OutputRecord& output);

/// One record for each feature of a building, for FeatureRecordWriter (docs/tables.md): none if it
/// was rejected. `result` is what label() or segment() said of it, with all attributes measured.
std::vector<FeatureRecord> feature_records(const Building& building, const PipelineResult& result);

/// The text of a mesh file, OBJ, OFF, PLY, STL or GLB, of what append_mesh() gathered of all its
/// records.
std::string mesh_text(Format format, const MeshSource& mesh,
                      StlSolids solids = StlSolids::by_label);

/// One record on its way into a file: buildings come one by one, and are kept only where the format
/// needs all of them.
class RecordText {
 public:
  /// `format` is one that is written (as_written()); `document` must outlive it.
  RecordText(Format format, const Document& document, WriteOptions options = {});
  RecordText(const RecordText&) = delete;
  RecordText& operator=(const RecordText&) = delete;

  /// What is to be written. take() moves its buildings on, but for those of meshes.
  OutputRecord output;
  void take();
  void add(const LabelledBuilding& building);

  /// All were taken. What the record adds to the file, as bytes; empty for meshes, which are made
  /// of the buildings when all are there. `issues` gets what is found: E166 (warning) of CityGML
  /// with WriteOptions::closes_installations.
  [[nodiscard]] std::string text(std::vector<Issue>& issues);
  /// The text is a CityJSON file, which can be had piece by piece instead; all that can fail is
  /// done by finish().
  [[nodiscard]] bool is_file() const;
  void finish() { text_.finish(); }
  void write(const std::function<void(std::string_view)>& sink);

 private:
  void note_written(std::size_t bytes) const;

  Format format_;
  const Document& document_;
  CityJsonText text_;
  std::size_t buildings_ = 0;
};

/// A file of records while it is written, in any format; it appears whole or not at all. Failures
/// throw OutputError E601.
class RecordFile {
 public:
  /// `format` is one that is written (as_written()). "-" is stdout.
  RecordFile(std::string path, Format format, StlSolids solids = StlSolids::by_label);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;

  /// Puts a record behind those before it, whose text it was.
  void take(const Document& document, const std::vector<LabelledBuilding>& labelled,
            const std::string& text);
  /// The same of one that is_file().
  void take(const Document& document, RecordText& record);
  /// Puts the file in its place. Returns what was found, once for all records: E165, and E161 for
  /// CityGML and a GeoPackage of buildings without a reference system, both warnings.
  std::vector<Issue> commit();

  /// How many bytes it has so far.
  [[nodiscard]] std::uint64_t size() const { return file_.size(); }

 private:
  std::string note_crs(const Document& document);

  std::string path_;
  Format format_;
  StlSolids solids_;
  OutputFile file_;
  MeshSource mesh_;
  std::unique_ptr<CityJsonCollector> collector_;
  std::unique_ptr<GpkgWriter> gpkg_;
  bool has_crs_ = false, has_buildings_ = false;
};

/// Writes the records of one file, in their order, to the file `path`, which appears when it is
/// whole. Its name says the format, unless `to` does: CityJSON (.city.json), CityJSONSeq
/// (.city.jsonl), CityGML 2.0 (.gml) or 3.0, GeoPackage (.gpkg), OBJ, OFF, PLY, GLB or STL, whose
/// solids `solids` names. Returns what RecordFile::commit() says. Throws InputError E106 for
/// another name, and for a CityJSONSeq that would become a CityJSON file or the other way round;
/// OutputError E601 if the file cannot be written.
std::vector<Issue> write(const std::string& path, std::span<const Document> documents,
                         std::span<const OutputRecord> outputs,
                         StlSolids solids = StlSolids::by_label,
                         std::optional<Format> to = std::nullopt);

}  // namespace oriel
