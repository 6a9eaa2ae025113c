#include "oriel/write.h"

#include "io/citygml/write/citygml_writer.h"
#include "io/cityjson/cityjson_collector.h"
#include "io/gltf/glb_writer.h"
#include "io/gpkg/gpkg_rows.h"
#include "io/gpkg/gpkg_writer.h"
#include "kernel/base/issue.h"
#include "kernel/base/log.h"

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

Issue no_crs(const std::string& path) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E161;
  issue.place.file = path;
  issue.sentence =
      "has no coordinate reference system, as its input names none: programs do not know where on "
      "the Earth it lies";
  return issue;
}

/// The format that is asked for, or that the name says, if records of this kind can be written in
/// it.
Format checked_format(const std::string& path, std::span<const Document> documents,
                      std::optional<Format> to) {
  const auto named = to ? to : format_of(path);
  if (!named)
    refuse(path,
           "names no format that can be written: .city.json, .city.jsonl, .gml, .gpkg, .obj, .off, "
           ".ply, .stl, .glb");
  const Format format = as_written(*named);
  for (const Document& document : documents) {
    const bool is_stream = document.format == Format::cityjson_seq;
    const bool becomes_stream = format == Format::cityjson_seq;
    if (document.format == Format::citygml || is_stream == becomes_stream) continue;
    if (becomes_stream || format == Format::cityjson)
      refuse(path, fmt::format("{} cannot be written as {}", to_string(document.format),
                               to_string(format)));
  }
  return format;
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

RecordFile::RecordFile(std::string path, Format format, StlSolids solids)
    : path_(std::move(path)),
      format_(format),
      solids_(solids),
      file_(path_),
      collector_(std::make_unique<CityJsonCollector>()) {
  if (format == Format::gpkg) gpkg_ = std::make_unique<GpkgWriter>(path_);
}

RecordFile::~RecordFile() = default;

RecordText::RecordText(Format format, const Document& document, WriteOptions options)
    : output{{}, std::move(options)},
      format_(format),
      document_(document),
      text_(document, output.options) {}

void RecordText::take() {
  if (is_mesh(format_)) return;
  for (const LabelledBuilding& building : output.buildings) add(building);
  output.buildings.clear();
}

void RecordText::add(const LabelledBuilding& building) {
  ++buildings_;
  if (!is_mesh(format_)) text_.add(building);
}

std::string RecordText::text(std::vector<Issue>& issues) {
  if (is_mesh(format_)) return {};
  std::string text = text_.text();
  note_written(text.size());
  if (is_written_citygml(format_))
    return citygml_text(text, document_, format_, output.options.closes_installations, issues);
  if (format_ == Format::gpkg) return gpkg_rows(text, document_, output.features);
  return text;
}

void RecordText::write(const std::function<void(std::string_view)>& sink) {
  std::size_t bytes = 0;
  text_.write([&](std::string_view piece) {
    bytes += piece.size();
    sink(piece);
  });
  note_written(bytes);
}

void RecordText::note_written(std::size_t bytes) const {
  log("oriel").debug("written: record={} buildings={} bytes={}", document_.name, buildings_, bytes);
}

bool RecordText::is_file() const {
  return format_ == Format::cityjson && document_.format == Format::cityjson;
}

std::string RecordFile::note_crs(const Document& document) {
  std::string crs;
  for (const Building& building : document.buildings) {
    has_buildings_ = true;
    if (crs.empty()) crs = building.frame.crs;
  }
  has_crs_ |= !crs.empty();
  return crs;
}

void RecordFile::take(const Document& document, RecordText& record) {
  note_crs(document);
  record.write([&](std::string_view piece) { file_.append(piece); });
}

void RecordFile::take(const Document& document, const std::vector<LabelledBuilding>& labelled,
                      const std::string& text) {
  const std::string crs = note_crs(document);
  if (is_mesh(format_))
    append_mesh(mesh_, document, labelled);
  else if (gpkg_)
    gpkg_->take(text, crs);
  else if (format_ == Format::cityjson && document.format == Format::citygml)
    collector_->add(text);
  else
    file_.append(text);
}

std::vector<Issue> RecordFile::commit() {
  std::vector<Issue> issues;
  if (collector_->has_lines()) file_.append(collector_->text());
  if (is_mesh(format_)) file_.append(mesh_text(format_, mesh_, solids_));
  if (is_written_citygml(format_)) file_.append(citygml_end());
  if (gpkg_) issues = gpkg_->end(file_);
  file_.commit();
  if ((gpkg_ || is_written_citygml(format_)) && has_buildings_ && !has_crs_)
    issues.push_back(no_crs(path_));
  return issues;
}

std::vector<Issue> write(const std::string& path, std::span<const Document> documents,
                         std::span<const OutputRecord> outputs, StlSolids solids,
                         std::optional<Format> to) {
  const Format format = checked_format(path, documents, to);
  RecordFile file(path, format, solids);
  std::vector<Issue> issues;
  for (std::size_t i = 0; i < documents.size(); ++i) {
    RecordText record(format, documents[i], outputs[i].options);
    record.output.features = outputs[i].features;
    for (const LabelledBuilding& building : outputs[i].buildings) record.add(building);
    file.take(documents[i], outputs[i].buildings, record.text(issues));
  }
  for (Issue& issue : file.commit()) issues.push_back(std::move(issue));
  return issues;
}

}  // namespace oriel
