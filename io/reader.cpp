#include "io/reader.h"

#include "io/citygml/citygml_reader.h"
#include "io/cityjson/cityjson_reader.h"
#include "io/cityjson/cityjson_source.h"
#include "io/files/input.h"
#include "io/mesh/mesh_reader.h"

#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

Format format_to_read(const std::string& path, const ReadOptions& options) {
  const auto format = options.format ? options.format : format_of(path);
  const TextName name{path == "-" ? "stdin" : path, 0};
  if (!format)
    throw InputError(error_in(
        name, {Code::E106,
               "the format is unknown; expected a name in .city.json, .city.jsonl, .gml, .obj, "
               ".off, .ply or .stl, or --from cityjson, cityjsonseq, citygml, obj, off, ply or "
               "stl"}));
  if (*format == Format::gpkg)
    throw InputError(error_in(
        name, {Code::E106, "a GeoPackage is written only; read the file that it was made of"}));
  if (*format == Format::glb)
    throw InputError(
        error_in(name, {Code::E106, "GLB is written only: its triangles are for viewers"}));
  if (!is_readable(*format))
    throw InputError(error_in(
        name, {Code::E106, fmt::format("{} names what is written; every version is read as citygml",
                                       to_string(*format))}));
  return *format;
}

bool is_blank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

}  // namespace

struct Reader::State {
  State(std::string path, ReadOptions options)
      : format(format_to_read(path, options)),
        name{path == "-" ? "stdin" : path, 0},
        input(std::move(path)),
        cityjson(options),
        citygml(input, name, options) {
    if (options.wants_sha256) input.hash();
  }

  std::string read_text();
  Checked<Document> read_file();
  std::optional<Checked<Document>> read_line();

  Format format;
  TextName name;
  Input input;
  detail::CityJsonReader cityjson;
  detail::CityGmlReader citygml;
  std::optional<detail::SequenceHeader> header;
  bool is_done = false;
};

Reader::Reader(std::string path, ReadOptions options)
    : state_(std::make_unique<State>(std::move(path), std::move(options))) {}

Reader::~Reader() = default;
Reader::Reader(Reader&&) noexcept = default;
Reader& Reader::operator=(Reader&&) noexcept = default;

Format Reader::format() const { return state_->format; }

int Reader::line() const { return state_->name.line; }

std::uint64_t Reader::bytes_read() const { return state_->input.bytes_read(); }

std::string Reader::sha256() const { return state_->input.digest(); }

const std::string& Reader::refused_line() const { return state_->cityjson.refused(); }

std::vector<UnreadObject> Reader::take_unread() {
  return state_->format == Format::citygml ? state_->citygml.take_unread()
                                           : state_->cityjson.take_unread();
}

std::optional<Checked<Document>> Reader::next() {
  if (state_->is_done) return std::nullopt;
  if (state_->format == Format::citygml) return state_->citygml.next();
  if (state_->format == Format::cityjson_seq) return state_->read_line();
  state_->is_done = true;
  return state_->read_file();
}

std::string Reader::State::read_text() {
  std::string text = input.read_all();
  if (const std::size_t bom = text.size() - without_bom(text).size(); bom > 0) text.erase(0, bom);
  return text;
}

Checked<Document> Reader::State::read_file() {
  std::string text = read_text();
  if (text.empty())
    return {std::nullopt,
            {error_in(name, {Code::E102, "the file is empty; write it again, or name another"})}};
  if (format == Format::obj) return detail::read_obj(text, name);
  if (format == Format::off) return detail::read_off(text, name);
  if (format == Format::ply) return detail::read_ply(text, name);
  if (format == Format::stl) return detail::read_stl(text, name);
  return cityjson.read(std::move(text), name, std::nullopt);
}

std::optional<Checked<Document>> Reader::State::read_line() {
  std::string line;
  while (true) {
    if (!input.read_line(line)) {
      is_done = true;
      if (header) return std::nullopt;
      return Checked<Document>{std::nullopt,
                               {error_in({name.file, 0}, {Code::E102,
                                                          "the file is empty; expected a CityJSON "
                                                          "header line"})}};
    }
    ++name.line;
    if (name.line == 1) line.erase(0, line.size() - without_bom(line).size());
    if (is_blank(line)) continue;
    auto record = cityjson.read(std::move(line), name, header);
    if (!record.value && record.issues.empty()) continue;  // the header once more
    if (!header && record.value) header = cityjson.header();
    if (!header) is_done = true;
    return record;
  }
}

std::string_view source_line(const Document& document) {
  if (document.format != Format::cityjson_seq || !document.source) return {};
  return document.source->text;
}

}  // namespace oriel
