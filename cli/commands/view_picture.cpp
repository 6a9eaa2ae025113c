#include "cli/commands/view_picture.h"

#include "cli/commands/options.h"
#include "kernel/base/text/counted.h"
#include "oriel/generalise.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// Buildings that are farther apart cannot be seen in one picture: a town is.
constexpr double kMostApart_m = 20'000;

const std::map<std::string, PictureFormat> kEndings{
    {".png", PictureFormat::png}, {".svg", PictureFormat::svg}, {".pdf", PictureFormat::pdf}};

/// Two whole numbers, "1200,900" or "4x3".
std::pair<int, int> two_numbers(const std::string& text, char between, const std::string& option,
                                const char* example, int least, int most) {
  const auto refuse = [&] [[noreturn]] {
    throw CLI::ValidationError(
        option, fmt::format("'{}' is no pair of numbers from {} to {}, as in '{}'", text, least,
                            most, example));
  };
  const std::size_t at = text.find(between);
  if (at == std::string::npos) refuse();
  std::pair<int, int> out;
  const auto read = [&](const char* from, const char* to, int& number) {
    const auto [end, fault] = std::from_chars(from, to, number);
    if (fault != std::errc() || end != to || number < least || number > most) refuse();
  };
  read(text.data(), text.data() + at, out.first);
  read(text.data() + at + 1, text.data() + text.size(), out.second);
  return out;
}

/// "north", "n" or degrees.
double side_deg(const std::string& text) {
  static const std::map<std::string, double> names{
      {"north", 0}, {"east", 90}, {"south", 180}, {"west", 270}};
  for (const auto& [name, degrees] : names)
    if (text == name || text == name.substr(0, 1)) return degrees;
  double degrees = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), degrees);
  if (fault == std::errc() && end == text.data() + text.size() && degrees >= 0 && degrees <= 360)
    return degrees;
  throw CLI::ValidationError(
      "--facade",
      fmt::format("'{}' is no side: north, east, south, west, or degrees clockwise from north",
                  text));
}

using FeatureName = std::pair<std::string, std::string>;

/// By building and id of each part the box of its faces.
std::map<FeatureName, Box> boxes_of(const MeshSource& mesh) {
  std::map<FeatureName, Box> boxes;
  for (const MeshPolygon& polygon : mesh.polygons) {
    if (polygon.feature < 0) continue;
    const MeshFeature& feature = mesh.features[static_cast<std::size_t>(polygon.feature)];
    if (feature.id.empty()) continue;
    for (const auto& ring : polygon.rings)
      for (const int v : ring)
        boxes[{feature.building, feature.id}].grow(mesh.points[static_cast<std::size_t>(v)]);
  }
  return boxes;
}

/// A part that has moved or grown by less looks the same.
constexpr double kSamePlace_m = 0.01;

bool is_same(const Box& p, const Box& q) {
  return length(p.min - q.min) < kSamePlace_m && length(p.max - q.max) < kSamePlace_m;
}

/// What is in one of two panels only, or lies elsewhere in the other one.
std::vector<FeatureName> differences(const MeshSource& before, const MeshSource& after) {
  const auto old = boxes_of(before), now = boxes_of(after);
  std::vector<FeatureName> names;
  for (const auto& [name, box] : old)
    if (const auto found = now.find(name); found == now.end() || !is_same(box, found->second))
      names.push_back(name);
  for (const auto& [name, box] : now)
    if (!old.contains(name)) names.push_back(name);
  std::ranges::sort(names);
  return names;
}

/// "1:5000: 12 windows, 3 other parts".
std::string drawn_caption(const std::string& target, const MeshSource& mesh) {
  std::set<int> features;
  for (const MeshPolygon& polygon : mesh.polygons) features.insert(polygon.feature);
  std::size_t openings = 0;
  for (const int feature : features) {
    if (feature < 0) continue;
    const std::string& label = mesh.features[static_cast<std::size_t>(feature)].label;
    if (label == "window" || label == "door") ++openings;
  }
  return fmt::format("{}: {}", target, counted(openings, "opening"));
}

}  // namespace

std::optional<PictureFormat> picture_format(const std::string& path) {
  for (const auto& [ending, format] : kEndings)
    if (path.ends_with(ending)) return format;
  return std::nullopt;
}

void add_picture_arguments(CLI::App& command, PictureArguments& arguments) {
  constexpr const char* kGroup = "Pictures (-o FILE.png, .svg or .pdf)";
  const auto add = [&](CLI::Option* option) {
    option->group(kGroup);
    return option;
  };
  PictureOptions& options = arguments.options;
  add(command
          .add_option("--azimuth", options.azimuth_deg,
                      "Where the viewer stands, in degrees clockwise from north")
          ->check(CLI::Range(-360.0, 360.0))
          ->capture_default_str());
  add(command.add_option("--elevation", options.elevation_deg, "How high, in degrees")
          ->check(CLI::Range(-90.0, 90.0))
          ->capture_default_str());
  add(command.add_option("--facade", arguments.facade,
                         "Looks straight at the largest facade of a side: north, east, south, west "
                         "or degrees"));
  add(command.add_flag("--plan", arguments.is_plan, "Looks from straight above, north up"));
  add(command.add_option("--size", arguments.size,
                         "Width and height in pixels, 1200,900 if not given"));
  add(command.add_option("--grid", arguments.grid,
                         "A panel for each building, so many beside and below each other: 4x3"));
  add(command
          .add_option("--scales", arguments.scale_texts,
                      "A panel for each scale, with the building as it is drawn for it")
          ->delimiter(','));
  add(command
          .add_option("--at-map-size", options.map_dpi,
                      "With --scales: each drawing once more as large as on a map of so many dots "
                      "an inch, 300 for paper")
          ->check(CLI::Range(50.0, 1200.0)));
  add(command.add_flag("--dark", options.is_dark, "Dark ground"));
  add(command.add_flag("--transparent", options.is_transparent, "No ground"));
  add(command.add_flag("--scale-bar", options.has_scale_bar, "A bar of metres"));
  add(command.add_flag("--no-legend", arguments.has_no_legend, "No list of classes"));
}

void settle(PictureArguments& arguments, bool is_picture, bool has_after) {
  PictureOptions& options = arguments.options;
  const PictureOptions usual;
  const bool says_anything =
      !arguments.facade.empty() || !arguments.size.empty() || !arguments.grid.empty() ||
      !arguments.scale_texts.empty() || arguments.is_plan || arguments.has_no_legend ||
      options.is_dark || options.is_transparent || options.has_scale_bar ||
      options.azimuth_deg != usual.azimuth_deg || options.elevation_deg != usual.elevation_deg;
  if (!is_picture) {
    if (says_anything)
      throw CLI::ValidationError("-o",
                                 "options of pictures need a name that ends in .png, .svg or "
                                 ".pdf");
    return;
  }
  if (arguments.is_plan && !arguments.facade.empty())
    throw CLI::ValidationError("--plan", "excludes --facade");
  if (arguments.is_plan) options.view = PictureView::plan;
  if (!arguments.facade.empty()) {
    options.view = PictureView::facade;
    options.azimuth_deg = side_deg(arguments.facade);
  }
  if (!arguments.size.empty())
    std::tie(options.width_px, options.height_px) =
        two_numbers(arguments.size, ',', "--size", "1200,900", kLeastPicture_px, kMostPicture_px);
  if (!arguments.grid.empty()) {
    const auto [columns, rows] = two_numbers(arguments.grid, 'x', "--grid", "4x3", 1, 100);
    options.columns = columns;
    arguments.most_panels = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  if (options.map_dpi > 0 && arguments.scale_texts.empty())
    throw CLI::ValidationError("--at-map-size", "needs --scales");
  arguments.scales = scales_of(arguments.scale_texts, "--scales");
  if (has_after && (!arguments.grid.empty() || !arguments.scales.empty()))
    throw CLI::ValidationError("--after", "excludes --grid and --scales");
  options.has_legend = !arguments.has_no_legend;
}

void PanelGatherer::add(const Document& document, const Building& building,
                        const PipelineResult& result) {
  if (arguments_.most_panels && panels_.size() >= *arguments_.most_panels) {
    ++left_out_;
    return;
  }
  const bool has_own_panel = !arguments_.grid.empty() || !arguments_.scales.empty();
  if (has_own_panel || panels_.empty())
    panels_.push_back({.caption = has_own_panel ? building.id : std::string()});
  append_building(panels_.back().mesh, building, annotate(building, result, rules_, options_));
  if (!arguments_.scales.empty()) add_scales(document, building, result);
}

void PanelGatherer::add_scales(const Document& document, const Building& building,
                               const PipelineResult& result) {
  panels_.back().caption = drawn_caption(building.id, panels_.back().mesh);
  panels_.back().frame = static_cast<int>(panels_.size());
  const int frame = panels_.back().frame;
  for (const double scale : arguments_.scales) {
    GeneraliseOptions options;
    static_cast<LabelOptions&>(options) = options_;
    OutputRecord output;
    oriel::add(generalise(document, building, result, rules_, at_scale(scale), options), output);
    PicturePanel panel{.frame = frame, .map_scale = scale};
    for (const LabelledBuilding& drawn : output.buildings)
      append_building(panel.mesh, building, drawn);
    panel.caption = drawn_caption(at_scale(scale).text(), panel.mesh);
    if (output.buildings.empty()) panel.caption = at_scale(scale).text() + ": not drawn";
    panels_.push_back(std::move(panel));
  }
}

LabelledBuilding labelled_as(const Building& building, const CarriedLabels& carried) {
  LabelledBuilding made;
  made.building = building.id;
  made.surface_of_polygon.assign(carried.surfaces.size(), -1);
  for (std::size_t i = 0; i < carried.surfaces.size(); ++i) {
    if (carried.surfaces[i].type.empty()) continue;
    made.surface_of_polygon[i] = static_cast<int>(made.surfaces.size());
    made.surfaces.push_back({.type = carried.surfaces[i].type, .members = {}});
  }
  // Surfaces stand first: an opening is none of what it lies in.
  std::vector<bool> is_taken(carried.surfaces.size());
  for (const CarriedFeature& feature : carried.features) {
    const int surface = static_cast<int>(made.surfaces.size());
    made.surfaces.push_back(
        {.type = {}, .members = {{"oriel_label", feature.label}, {"oriel_id", feature.id}}});
    for (const int polygon : feature.polygons) {
      const auto i = static_cast<std::size_t>(polygon);
      const std::string& type = carried.surfaces.at(i).type;
      if (is_taken[i] && (type == "Window" || type == "Door")) continue;
      made.surface_of_polygon[i] = surface;
      is_taken[i] = true;
    }
  }
  return made;
}

void PanelGatherer::begin_after(const std::string& before, const std::string& after) {
  if (!has_after_) panels_.front().caption = before;
  has_after_ = true;
  panels_.front().frame = 0;
  panels_.push_back({.caption = after, .frame = 0});
}

void PanelGatherer::add_after(const Building& building, const PipelineResult& result,
                              const CarriedLabels* carried) {
  append_building(panels_.back().mesh, building,
                  carried == nullptr ? annotate(building, result, rules_, options_)
                                     : labelled_as(building, *carried));
}

std::vector<PicturePanel> PanelGatherer::panels() const {
  std::vector<PicturePanel> panels = panels_;
  for (std::size_t i = 1; i < panels.size() && has_after_; ++i)
    panels[i].marked = differences(panels.front().mesh, panels[i].mesh);
  if (has_after_ && panels.size() == 2) panels.front().marked = panels.back().marked;
  Box box;
  for (PicturePanel& panel : panels) {
    // Those of one frame move together.
    const bool goes_on =
        panel.frame >= 0 && &panel != &panels.front() && panel.frame == (&panel - 1)->frame;
    if (!goes_on) {
      box = {};
      for (const Vec3 point : panel.mesh.points) box.grow(point);
    }
    if (box.is_empty()) continue;
    const Vec3 size = box.max - box.min;
    if (std::max(size.x, size.y) > kMostApart_m) {
      Issue issue;
      issue.code = Code::E163;
      issue.sentence = fmt::format(
          "the buildings lie over {:.0f} km: in one picture none would be seen; --grid gives each "
          "its own panel",
          std::max(size.x, size.y) / 1000);
      throw InputError(std::move(issue));
    }
    for (Vec3& point : panel.mesh.points) point = point - box.min;
  }
  return panels;
}

}  // namespace oriel::cli
