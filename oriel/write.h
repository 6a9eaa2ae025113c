#pragma once

#include "kernel/io/document.h"
#include "kernel/io/files/format.h"
#include "kernel/io/files/output_file.h"
#include "kernel/io/mesh/mesh_writer.h"
#include "kernel/io/records/feature_records.h"
#include "kernel/io/writer.h"
#include "kernel/model/labelled_building.h"
#include "oriel/result.h"

#include <span>
#include <string>
#include <vector>

namespace oriel {

/// What is to be written of one record.
struct OutputRecord {
  std::vector<LabelledBuilding> buildings;
  WriteOptions options{};
};

/// Adds a building, such as PipelineResult::output or Repaired::output. One without id, of which
/// nothing could be made, is passed over: it is written unchanged.
void add(LabelledBuilding building, OutputRecord& output);

/// A record as CityJSON with its labels: the text of a file, or of a CityJSONSeq one line with its
/// line end. What the labels do not concern stays byte for byte; write_cityjson() in
/// kernel/io/writer.h says what becomes of the rest.
std::string write(const Document& document, const OutputRecord& output);

/// One record for each feature of a building, for FeatureRecordWriter (docs/formats.md): none if it
/// was rejected. `result` is what label() or segment() said of it, with all attributes measured.
std::vector<FeatureRecord> feature_records(const Building& building, const PipelineResult& result);

/// The text of a mesh file, OBJ, OFF, PLY, STL or GLB, of what append_mesh() gathered of all its
/// records.
std::string mesh_text(Format format, const MeshSource& mesh,
                      StlSolids solids = StlSolids::by_label);

/// Writes the records of one file, in their order, to the file `path`, which appears when it is
/// whole. Its name says the format: CityJSON (.city.json), CityJSONSeq (.city.jsonl), OBJ, OFF, PLY,
/// GLB or STL, whose solids `solids` names. CityGML becomes either of the first two. Throws InputError
/// E106 for another name, and for a CityJSONSeq that would become a CityJSON file or the other way
/// round; OutputError E601 if the file cannot be written.
void write(const std::string& path, std::span<const Document> documents,
           std::span<const OutputRecord> outputs, StlSolids solids = StlSolids::by_label);

}  // namespace oriel
