#include "cli/commands/view_picture.h"

#include "cli/commands/options.h"
#include "cli/terminal/logging.h"
#include "kernel/base/text/counted.h"
#include "oriel/generalise.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

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

/// "1:5000: 12 openings": windows and doors by the type of their surfaces, whatever a pack calls
/// them.
std::string drawn_caption(const std::string& target, const MeshSource& mesh) {
  std::set<int> openings;
  for (const MeshPolygon& polygon : mesh.polygons)
    if (polygon.surface == "Window" || polygon.surface == "Door") openings.insert(polygon.feature);
  return fmt::format("{}: {}", target, counted(openings.size(), "opening"));
}

/// Puts what a file says of a building's parts in the form in which it is written.
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

}  // namespace

std::optional<PictureFormat> picture_format(const std::string& path) {
  for (const auto& [ending, format] : kEndings)
    if (path.ends_with(ending)) return format;
  return std::nullopt;
}

std::vector<CLI::Option*> add_picture_arguments(CLI::App& command, PictureArguments& arguments) {
  std::vector<CLI::Option*> added;
  const auto add = [&](CLI::Option* option) {
    option->group("Pictures (-o FILE.png, .svg or .pdf)");
    return added.emplace_back(option);
  };
  PictureOptions& options = arguments.options;
  CLI::Option* azimuth = add(command
                                 .add_option("--azimuth", options.azimuth_deg,
                                             "Degrees clockwise from north where the viewer stands")
                                 ->check(CLI::Range(-360.0, 360.0))
                                 ->capture_default_str());
  CLI::Option* elevation = add(
      command
          .add_option("--elevation", options.elevation_deg, "Degrees above the ground, likewise")
          ->check(CLI::Range(-90.0, 90.0))
          ->capture_default_str());
  CLI::Option* facade = add(command.add_option(
      "--facade", arguments.facade,
      "Look straight at the largest facade of a side: north, east, south, west or degrees"));
  CLI::Option* plan =
      add(command.add_flag("--plan", arguments.is_plan, "Look from straight above, north up"));
  for (CLI::Option* view : {facade, plan}) view->excludes(azimuth)->excludes(elevation);
  plan->excludes(facade);
  add(command.add_option("--size", arguments.size,
                         "Width and height in pixels (default 1200,900)"));
  CLI::Option* grid = add(
      command.add_option("--grid", arguments.grid,
                         "Give each building a panel; 4x3: four beside each other, three rows"));
  CLI::Option* scales =
      add(command
              .add_option("--scales", arguments.scale_texts,
                          "Give each scale a panel with the building as it is drawn for it")
              ->delimiter(','));
  CLI::Option* after = command.get_option("--after");
  grid->excludes(scales)->excludes(after);
  scales->excludes(after);
  add(command
          .add_option("--at-map-size", options.map_dpi,
                      "Draw each scale once more as large as on a map with DPI dots per inch, 300 "
                      "for paper")
          ->type_name("DPI")
          ->check(CLI::Range(50.0, 1200.0))
          ->needs(scales));
  add(command.add_flag("--dark", options.is_dark, "Draw on dark ground"));
  add(command.add_flag("--transparent", options.is_transparent, "Draw on no ground"));
  add(command.add_flag("--scale-bar", options.has_scale_bar, "Add a bar of metres"));
  add(command.add_flag("--no-legend", arguments.has_no_legend, "Leave out the list of classes"));
  return added;
}

void settle(PictureArguments& arguments) {
  PictureOptions& options = arguments.options;
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
  arguments.scales = scales_of(arguments.scale_texts, "--scales");
  options.has_legend = !arguments.has_no_legend;
}

LabelledBuilding PictureExhibit::labelled(const Building& building,
                                          const PipelineResult& result) const {
  if (result.has_surfaces()) return annotate(building, result, rules_, options_);
  LabelledBuilding bare;
  bare.building = building.id;
  return bare;
}

std::vector<Issue> PictureExhibit::add(const Document& document, const Building& building,
                                       const PipelineResult& result) {
  if (arguments_.most_panels && panels_.size() >= *arguments_.most_panels) {
    ++left_out_;
    return {};
  }
  const bool has_own_panel = arguments_.most_panels || !arguments_.scales.empty();
  if (has_own_panel || panels_.empty())
    panels_.push_back({.caption = has_own_panel ? building.id : std::string()});
  append_building(panels_.back().mesh, building, labelled(building, result));
  return arguments_.scales.empty() ? std::vector<Issue>{} : add_scales(document, building, result);
}

std::vector<Issue> PictureExhibit::add_scales(const Document& document, const Building& building,
                                              const PipelineResult& result) {
  std::vector<Issue> issues;
  const int frame = static_cast<int>(panels_.size());
  panels_.back().caption = drawn_caption(building.id, panels_.back().mesh);
  panels_.back().frame = frame;
  for (const double scale : arguments_.scales) {
    GeneraliseOptions options;
    static_cast<LabelOptions&>(options) = options_;
    const Targets target = at_scale(scale);
    GeneralisedBuilding drawn = generalise(document, building, result, rules_, target, options);
    for (const Issue& issue : drawn.issues) {
      const auto is_said = [&](const Issue& said) { return said.sentence == issue.sentence; };
      if (std::ranges::none_of(issues, is_said)) issues.push_back(issue);  // once for all scales
    }
    OutputRecord output;
    oriel::add(std::move(drawn), output);
    PicturePanel panel{.frame = frame, .map_scale = scale};
    for (const LabelledBuilding& one : output.buildings) append_building(panel.mesh, building, one);
    panel.caption = output.buildings.empty() ? target.text() + ": not drawn"
                                             : drawn_caption(target.text(), panel.mesh);
    panels_.push_back(std::move(panel));
  }
  return issues;
}

void PictureExhibit::begin_after(const std::string& file) {
  has_after_ = true;
  panels_.front().caption = before_;
  panels_.front().frame = 0;
  panels_.push_back({.caption = std::filesystem::path(file).filename().string(), .frame = 0});
}

void PictureExhibit::add_after(const Building& building, const PipelineResult& result,
                               const CarriedLabels* carried) {
  append_building(
      panels_.back().mesh, building,
      carried == nullptr ? labelled(building, result) : labelled_as(building, *carried));
}

std::string PictureExhibit::made() {
  if (left_out_ > 0)
    run_log().info("--grid {} has no room for {}", arguments_.grid,
                   counted(left_out_, "more building"));
  const std::size_t of_one = arguments_.scales.size() + 1;
  if (of_one > 1 && panels_.size() > of_one) arguments_.options.columns = static_cast<int>(of_one);
  for (std::size_t i = 1; i < panels_.size() && has_after_; ++i)
    panels_[i].marked = differences(panels_.front().mesh, panels_[i].mesh);
  if (has_after_ && panels_.size() == 2) panels_.front().marked = panels_.back().marked;
  Checked<std::string> drawn = picture(panels_, format_, arguments_.options);
  if (!drawn.value) throw InputError(std::move(drawn.issues.front()));
  return std::move(*drawn.value);
}

}  // namespace oriel::cli
