#include "cli/output/output_sink.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;

const char* extension_of(Format format) {
  switch (format) {
    case Format::cityjson:
      return ".city.json";
    case Format::cityjson_seq:
      return ".city.jsonl";
    case Format::citygml:
    case Format::citygml2:
    case Format::citygml3:
      return ".gml";
    case Format::gpkg:
      return ".gpkg";
    case Format::obj:
      return ".obj";
    case Format::off:
      return ".off";
    case Format::ply:
      return ".ply";
    case Format::stl:
      return ".stl";
    case Format::glb:
      return ".glb";
  }
  return "";
}

/// The file's name without folder and extensions that say its format.
std::string stem_of(const std::string& path) {
  std::string name = fs::path(path).filename().string();
  for (const std::string extension : {".city.jsonl", ".city.json", ".jsonl", ".json", ".citygml",
                                      ".gml", ".xml", ".obj", ".off", ".ply", ".stl"})
    if (name.size() > extension.size() && name.ends_with(extension))
      return name.substr(0, name.size() - extension.size());
  return name;
}

}  // namespace

OutputSink::OutputSink(std::string out, const std::string& to, std::vector<std::string> inputs,
                       std::optional<Format> from, StlSolids solids)
    : out_(std::move(out)), inputs_(std::move(inputs)), from_(from), solids_(solids) {
  if (!to.empty()) to_ = parse_format(to);
  is_folder_ = out_.ends_with('/') || fs::is_directory(out_);
  if (inputs_.size() > 1 && !is_folder_)
    throw CLI::ValidationError("-o", "several inputs need a folder: write it with a / at its end");
  if (!is_folder_ && out_ != "-" && !to_ && !format_of(out_))
    throw CLI::ValidationError(
        "-o", fmt::format("'{}' has no known extension; end it in .city.json, .city.jsonl, .obj, "
                          ".off, .ply, .stl, .glb, .gml or .gpkg, or say the format with --to",
                          out_));
  std::set<std::string> paths;
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    check(i);
    if (!paths.insert(path_for(i)).second)
      throw CLI::ValidationError(
          "-o", fmt::format("two inputs would both be written to '{}'", path_for(i)));
  }
}

Format OutputSink::format_of_input(std::size_t input) const {
  if (from_) return *from_;
  if (inputs_[input] == "-") return kFormatOfStdin;
  return format_of(inputs_[input]).value_or(Format::cityjson);
}

void OutputSink::check(std::size_t input) const {
  const Format from = format_of_input(input);
  const Format to = to_ ? *to_ : is_folder_ || out_ == "-" ? from : format_of(out_).value_or(from);
  if (from == Format::citygml) return;
  const bool is_stream_in = from == Format::cityjson_seq,
             is_stream_out = to == Format::cityjson_seq;
  if (is_stream_in != is_stream_out && (is_stream_out || to == Format::cityjson))
    throw CLI::ValidationError(
        "-o", fmt::format("{} cannot be written as {}: oriel {} turns one into the other",
                          to_string(from), to_string(to), is_stream_in ? "collect" : "cat"));
}

std::string OutputSink::path_for(std::size_t input) const {
  if (!is_folder_) return out_;
  const Format from = format_of_input(input);
  Format to = to_.value_or(from);
  // CityGML and meshes with labels are CityJSON unless asked otherwise.
  if (!to_ && (from == Format::citygml || is_mesh(from))) to = Format::cityjson;
  return (fs::path(out_) / (stem_of(inputs_[input]) + extension_of(to))).string();
}

void OutputSink::name_files(NamedFiles& files, bool is_selection) const {
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    files.add_output("-o", path_for(i), loss(i, is_selection));
}

/// What the input would lose if its output replaced it.
std::string OutputSink::loss(std::size_t input, bool is_selection) const {
  const Format to = format_of_output(input);
  const bool is_stream = to == Format::cityjson_seq;
  if (to != format_of_input(input) || (to != Format::cityjson && !is_stream))
    return fmt::format("{} would keep only what oriel reads of it", to_string(to));
  if (is_stream && is_selection)
    return "only the records that --id, --bbox, --cotype, --random and --exclude select would be "
           "kept";
  return {};
}

Format OutputSink::format_of_output(std::size_t input) const {
  if (to_) return *to_;
  const Format from = format_of_input(input);
  return as_written(
      format_of(path_for(input)).value_or(from == Format::cityjson_seq ? from : Format::cityjson));
}

bool OutputSink::is_gathering(std::size_t input) const { return is_mesh(format_of_output(input)); }

bool OutputSink::is_streaming() const {
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const Format to = to_ ? *to_ : format_of(path_for(i)).value_or(format_of_input(i));
    const bool is_stream = to == Format::cityjson_seq || is_written_citygml(as_written(to));
    if (!is_stream || format_of_input(i) != Format::cityjson_seq) return false;
  }
  return true;
}

bool OutputSink::is_citygml() const {
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    if (!is_written_citygml(format_of_output(i))) return false;
  return true;
}

bool OutputSink::is_cityjson() const {
  const auto is_json = [](Format f) { return f == Format::cityjson || f == Format::cityjson_seq; };
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    if (!is_json(format_of_output(i)) || !is_json(format_of_input(i))) return false;
  return true;
}

bool OutputSink::has_attributes() const {
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    if (format_of_output(i) == Format::gpkg) return true;
  return false;
}

bool OutputSink::gathers_any() const {
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    if (is_gathering(i)) return true;
  return has_attributes();
}

bool OutputSink::names_features() const {
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const Format to = format_of_output(i);
    const bool is_by_class = to == Format::stl && solids_ == StlSolids::by_class;
    if (to != Format::off && !is_by_class) return true;
  }
  return false;
}

void OutputSink::begin(std::size_t input, bool is_rehearsal) {
  input_ = input;
  path_ = path_for(input);
  if (is_rehearsal) path_ = "/dev/null";
  if (is_folder_ && !is_rehearsal) {
    std::error_code error;
    fs::create_directories(out_, error);  // what is wrong with it shows when the file is opened
  }
  file_ = std::make_unique<RecordFile>(path_, format_of_output(input), solids_);
}

std::shared_ptr<RecordText> OutputSink::record(std::size_t input, const Document& document,
                                               WriteOptions options) const {
  return std::make_shared<RecordText>(format_of_output(input), document, std::move(options));
}

void OutputSink::finish(std::shared_ptr<RecordText> record, Product& product) {
  if (record->is_file()) {
    record->finish();
    product.file = std::move(record);
    return;
  }
  product[OutputPart::buildings] = record->text(product.issues);
  product.labelled = std::move(record->output.buildings);
}

void OutputSink::take(const Document& document, const Product& product) {
  if (product.file)
    file_->take(document, *product.file);
  else
    file_->take(document, product.labelled, product[OutputPart::buildings]);
}

void OutputSink::add(const Document& document, OutputRecord output) {
  auto one = record(input_, document, output.options);
  one->output.buildings = std::move(output.buildings);
  one->output.features = std::move(output.features);
  one->take();
  Product product;
  finish(std::move(one), product);
  take(document, product);
  std::ranges::move(product.issues, std::back_inserter(issues_));
}

PartPlace OutputSink::place() const { return {path_, file_ ? file_->size() : 0}; }

std::string OutputSink::end() {
  for (Issue& issue : file_->commit()) issues_.push_back(std::move(issue));
  file_.reset();
  return path_;
}

}  // namespace oriel::cli
