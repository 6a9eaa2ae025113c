#include "oriel/write.h"

#include "kernel/base/issue.h"
#include "kernel/base/log.h"
#include "kernel/io/cityjson/cityjson_collector.h"
#include "kernel/io/gltf/glb_writer.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

[[noreturn]] void refuse(const std::string& path, std::string sentence) {
  Issue issue;
  issue.code = Code::E106;
  issue.sentence = std::move(sentence);
  issue.place.file = path;
  throw InputError(std::move(issue));
}

/// The format that the name says, if records of this kind can be written in it.
Format checked_format(const std::string& path, std::span<const Document> documents) {
  const auto format = format_of(path);
  if (!format || *format == Format::citygml)
    refuse(path,
           "names no format that can be written: .city.json, .city.jsonl, .obj, .off, .ply, .stl, "
           ".glb");
  for (const Document& document : documents) {
    const bool is_stream = document.format == Format::cityjson_seq;
    const bool becomes_stream = *format == Format::cityjson_seq;
    if (document.format == Format::citygml || is_stream == becomes_stream) continue;
    if (becomes_stream || *format == Format::cityjson)
      refuse(path, fmt::format("{} cannot be written as {}", to_string(document.format),
                               to_string(*format)));
  }
  return *format;
}

MeshSource mesh_of(std::span<const Document> documents, std::span<const OutputRecord> outputs) {
  MeshSource mesh;
  for (std::size_t i = 0; i < documents.size(); ++i)
    append_mesh(mesh, documents[i], outputs[i].buildings);
  return mesh;
}

}  // namespace

void add(LabelledBuilding building, OutputRecord& output) {
  if (!building.building.empty()) output.buildings.push_back(std::move(building));
}

std::string write(const Document& document, const OutputRecord& output) {
  std::string text = write_cityjson(document, output.buildings, output.options);
  log("oriel").debug("written: record={} buildings={} bytes={}", document.name,
                     output.buildings.size(), text.size());
  return text;
}

std::string mesh_text(Format format, const MeshSource& mesh, StlSolids solids) {
  return format == Format::obj   ? write_obj(mesh)
         : format == Format::off ? write_off(mesh)
         : format == Format::ply ? write_ply(mesh)
         : format == Format::glb ? write_glb(mesh)
                                 : write_stl(mesh, solids);
}

std::vector<FeatureRecord> feature_records(const Building& building, const PipelineResult& result) {
  if (!result.is_done()) return {};
  const bool has_labels = !result.interpretation.verdicts.empty();
  auto records =
      feature_records(building, *result.segmentation, result.description.table,
                      result.description.graph, has_labels ? &result.interpretation : nullptr);
  for (const LabelCorrection& correction : result.corrections) {
    FeatureRecord& record = records.at(correction.before.feature.index());
    record.corrected_by = correction.by;
    record.corrected_why = correction.why;
  }
  return records;
}

void write(const std::string& path, std::span<const Document> documents,
           std::span<const OutputRecord> outputs, StlSolids solids) {
  const Format format = checked_format(path, documents);
  OutputFile file(path);
  if (format != Format::cityjson && format != Format::cityjson_seq) {
    file.append(mesh_text(format, mesh_of(documents, outputs), solids));
    return file.commit();
  }
  CityJsonCollector collector;
  for (std::size_t i = 0; i < documents.size(); ++i) {
    const std::string text = write(documents[i], outputs[i]);
    if (format == Format::cityjson && documents[i].format == Format::citygml)
      collector.add(text);
    else
      file.append(text);
  }
  if (collector.has_lines()) file.append(collector.text());
  file.commit();
}

}  // namespace oriel
