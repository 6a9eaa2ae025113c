#include "oriel/picture.h"
#include "oriel/read.h"
#include "oriel/write.h"
#include "python/src/handles.h"

#include <algorithm>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <stdexcept>
#include <tuple>

namespace py = pybind11;

namespace oriel::python {

namespace {

using Files = std::vector<std::shared_ptr<const ReadFile>>;
using MadeList = std::vector<std::shared_ptr<const MadeItem>>;

/// `name` is what places and the record are called by; a text was put into a file for reading.
std::shared_ptr<const ReadFile> read_file(const std::string& path, const std::string& name,
                                          const std::string& lod, const std::string& format) {
  ReadOptions options;
  if (!lod.empty()) options.lod = lod;
  if (!format.empty() && !(options.format = parse_format(format)))
    throw py::value_error("'" + format +
                          "' is no format: cityjson, cityjsonseq, citygml, obj, off, ply");
  auto read_records = read(path, options);
  auto file = std::make_shared<ReadFile>(ReadFile{name, lod, {}, std::move(read_records.issues)});
  if (read_records.value) file->records = std::move(*read_records.value);
  const auto rename = [&](std::string& place) {
    if (name != path && place.starts_with(path)) place.replace(0, path.size(), name);
  };
  for (Issue& issue : file->issues) rename(issue.place.file);
  for (Document& document : file->records) rename(document.name);
  return file;
}

std::vector<ReadBuilding> buildings_of(const std::shared_ptr<const ReadFile>& file) {
  std::vector<ReadBuilding> buildings;
  for (std::size_t record = 0; record < file->records.size(); ++record)
    for (std::size_t i = 0; i < file->records[record].buildings.size(); ++i)
      buildings.emplace_back(file, record, i);
  return buildings;
}

py::array_t<double> vertices_of(const ReadBuilding& self) {
  const Building& building = self.building();
  py::array_t<double> out({building.vertices.size(), std::size_t{3}});
  auto cells = out.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < cells.shape(0); ++i) {
    const Vec3 v = building.vertices[static_cast<std::size_t>(i)] + building.frame.origin_m;
    cells(i, 0) = v.x;
    cells(i, 1) = v.y;
    cells(i, 2) = v.z;
  }
  return out;
}

std::vector<std::vector<std::vector<int>>> polygons_of(const ReadBuilding& self) {
  std::vector<std::vector<std::vector<int>>> polygons;
  for (const Polygon& polygon : self.building().polygons) polygons.push_back(polygon.rings);
  return polygons;
}

ExistingSemantics existing_of(const std::string& name) {
  if (name == "fill") return ExistingSemantics::fill;
  if (name == "keep") return ExistingSemantics::keep;
  if (name == "replace") return ExistingSemantics::replace;
  throw py::value_error("existing is '" + name + "'; expected fill, keep or replace");
}

/// The records of a file with what was made of their buildings.
std::vector<OutputRecord> outputs_of(const ReadFile& file, const MadeList& made,
                                     const std::string& existing, std::vector<Issue>& issues) {
  std::vector<OutputRecord> outputs(file.records.size());
  for (OutputRecord& output : outputs) output.options.existing = existing_of(existing);
  for (const auto& one : made)
    if (one->of().file().get() == &file) one->add_to(outputs[one->of().record()], issues);
  return outputs;
}

/// The attributes of features, which only a GeoPackage has.
void add_attributes(const ReadFile& file, const MadeList& made,
                    std::vector<OutputRecord>& outputs) {
  for (const auto& one : made) {
    const PipelineResult* result = one->labelled();
    if (result == nullptr || one->of().file().get() != &file) continue;
    auto& features = outputs[one->of().record()].features;
    for (FeatureRecord& record : feature_records(one->of().building(), *result))
      features.push_back(std::move(record));
  }
}

/// A warning for each class whose features have no type in the output.
std::vector<Issue> untyped(const MadeList& made) {
  std::map<std::string, int> labels;
  const RuleBase* rules = nullptr;
  for (const auto& one : made)
    if (const RuleBase* used = one->count(labels)) rules = used;
  return rules != nullptr ? report_untyped(labels, *rules) : std::vector<Issue>{};
}

std::vector<Issue> write_file(const std::string& path, const std::shared_ptr<const ReadFile>& file,
                              const MadeList& made, const std::string& existing) {
  std::vector<Issue> issues;
  auto outputs = outputs_of(*file, made, existing, issues);
  if (format_of(path) == Format::gpkg) add_attributes(*file, made, outputs);
  const bool is_by_class = std::ranges::any_of(
      made, [](const auto& one) { return one->solids() == StlSolids::by_class; });
  for (Issue& issue :
       write(path, file->records, outputs, is_by_class ? StlSolids::by_class : StlSolids::by_label))
    issues.push_back(std::move(issue));
  const auto format = format_of(path);
  if (format == Format::off || (format == Format::stl && is_by_class)) return issues;
  for (Issue& issue : untyped(made)) issues.push_back(std::move(issue));
  return issues;
}

std::string text_of(const std::shared_ptr<const ReadFile>& file, const MadeList& made,
                    const std::string& existing) {
  std::vector<Issue> issues;
  const auto outputs = outputs_of(*file, made, existing, issues);
  std::string text;
  for (std::size_t i = 0; i < outputs.size(); ++i) text += write(file->records[i], outputs[i]);
  return text;
}

PictureFormat picture_format_of(const std::string& name) {
  if (name == "png") return PictureFormat::png;
  if (name == "svg") return PictureFormat::svg;
  if (name == "pdf") return PictureFormat::pdf;
  throw py::value_error("format is '" + name + "'; expected png, svg or pdf");
}

/// The bytes of a picture, or why there is none. With `has_panels` each building has a panel.
std::pair<std::string, std::vector<Issue>> picture_of(const MadeList& made,
                                                      const std::string& format,
                                                      const PictureOptions& options,
                                                      bool has_panels) {
  std::vector<PicturePanel> panels;
  std::vector<Issue> issues;
  for (const auto& one : made) {
    OutputRecord output;
    one->add_to(output, issues);
    const Building& building = one->of().building();
    if (has_panels || panels.empty())
      panels.push_back({.caption = has_panels ? building.id : std::string()});
    for (const LabelledBuilding& labelled : output.buildings)
      append_building(panels.back().mesh, building, labelled);
  }
  auto drawn = picture(panels, picture_format_of(format), options);
  return {drawn.value.value_or(std::string()), std::move(drawn.issues)};
}

}  // namespace

void bind_buildings(py::module_& module) {
  py::class_<ReadFile, std::shared_ptr<ReadFile>>(module, "File", "A file as it was read.")
      .def_readonly("path", &ReadFile::path)
      .def_readonly("issues", &ReadFile::issues, "What is wrong with the records.")
      .def_property_readonly("records", [](const ReadFile& file) { return file.records.size(); })
      .def("buildings", [](const std::shared_ptr<ReadFile>& file) { return buildings_of(file); })
      .def("__repr__", [](const ReadFile& file) { return "<oriel.File '" + file.path + "'>"; });
  py::class_<ReadBuilding>(
      module, "Building",
      "One building, or building part, as read: the polygons of one geometry at one level of "
      "detail, and of the installations that were joined to it.")
      .def_property_readonly(
          "id", [](const ReadBuilding& b) { return b.building().id; },
          "The CityObject's id; of formats without ids the file's stem.")
      .def_property_readonly(
          "lod", [](const ReadBuilding& b) { return b.building().lod; },
          "The level of detail as the input has it, '2.2', or empty.")
      .def_property_readonly(
          "crs", [](const ReadBuilding& b) { return b.building().frame.crs; },
          "The coordinate reference system as the input has it, or empty.")
      .def_property_readonly(
          "is_solid", [](const ReadBuilding& b) { return b.building().is_solid; },
          "The input says that it is a solid.")
      .def_property_readonly("vertices", &vertices_of,
                             "An array of n x 3 doubles: metres, in the coordinates of the input.")
      .def_property_readonly("polygons", &polygons_of,
                             "By polygon its rings, each a list of rows of `vertices`: the outer "
                             "ring counter-clockwise as seen from outside, then holes.")
      .def_property_readonly(
          "file", [](const ReadBuilding& b) { return std::const_pointer_cast<ReadFile>(b.file()); },
          "The file that it was read from.")
      .def("__repr__", [](const ReadBuilding& b) {
        return "<oriel.Building '" + b.building().id +
               "': " + std::to_string(b.building().polygons.size()) + " polygons>";
      });
  // Shared values are not changed by anybody: const is dropped for pybind11's sake only.
  py::class_<MadeItem, std::shared_ptr<MadeItem>>(module, "Made", "What was made of a building.")
      .def_property_readonly("building", &MadeItem::of, "The building that it was made of.")
      .def_property_readonly("id", [](const MadeItem& made) { return made.of().building().id; })
      .def_property_readonly("issues", &MadeItem::issues,
                             "What was found on the way; an error says why nothing was made.")
      .def_property_readonly(
          "counts",
          [](const MadeItem& made) {
            std::map<std::string, int> labels;
            made.count(labels);
            return labels;
          },
          "How many features have each label; '' counts those without one.");
  module.def("picture",
             [](const MadeList& made, const std::string& format, const std::string& view,
                std::pair<double, double> direction_deg, std::pair<int, int> size_px, bool is_dark,
                bool is_transparent, bool has_legend, bool has_scale_bar, bool has_panels) {
               PictureOptions options;
               options.view = view == "plan"     ? PictureView::plan
                              : view == "facade" ? PictureView::facade
                                                 : PictureView::oblique;
               std::tie(options.azimuth_deg, options.elevation_deg) = direction_deg;
               std::tie(options.width_px, options.height_px) = size_px;
               options.is_dark = is_dark;
               options.is_transparent = is_transparent;
               options.has_legend = has_legend;
               options.has_scale_bar = has_scale_bar;
               auto drawn = [&] {
                 const py::gil_scoped_release unlocked;
                 return picture_of(made, format, options, has_panels);
               }();
               return std::pair(py::bytes(drawn.first), std::move(drawn.second));
             });
  module.def("read", &read_file, Unlocked());
  module.def("write", &write_file, Unlocked());
  module.def("to_text", &text_of, Unlocked());
}

}  // namespace oriel::python
