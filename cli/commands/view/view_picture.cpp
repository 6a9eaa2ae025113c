#include "cli/commands/view/view_picture.h"

#include "cli/options/options.h"
#include "cli/options/target_options.h"
#include "cli/terminal/logging.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "oriel/generalise.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <map>
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

/// Puts what a file says of a building's parts in the form in which it is written.
LabelledBuilding labelled_as(const Building& building, const CarriedLabels& carried) {
  LabelledBuilding made;
  made.building = building.id;
  made.surface_of_polygon.assign(carried.types.size(), -1);
  for (std::size_t i = 0; i < carried.types.size(); ++i) {
    if (carried.types[i].empty()) continue;
    made.surface_of_polygon[i] = static_cast<int>(made.surfaces.size());
    made.surfaces.push_back({.type = carried.types[i]});
  }
  // Surfaces stand first: an opening is none of what it lies in.
  std::vector<bool> is_taken(carried.types.size());
  for (const CarriedFeature& feature : carried.features) {
    const int surface = static_cast<int>(made.surfaces.size());
    made.surfaces.push_back(
        {.label = FeatureLabel{.id = feature.said.id, .label = feature.said.given()}});
    for (const int polygon : feature.polygons) {
      const auto i = static_cast<std::size_t>(polygon);
      if (is_taken.at(i) && is_opening_type(carried.types[i])) continue;
      made.surface_of_polygon[i] = surface;
      is_taken[i] = true;
    }
  }
  return made;
}

void exclude_each_other(const std::vector<CLI::Option*>& options) {
  for (CLI::Option* one : options)
    for (CLI::Option* other : options)
      if (one != other) one->excludes(other);
}

/// A feature is seen from where it looks, a little from the side and from above.
void look_at(const FeatureTable& table, FeatureId feature, PictureOptions& options) {
  constexpr double kAside_deg = 25;
  if (const auto azimuth = table.number(feature, Attribute::azimuth))
    options.azimuth_deg = *azimuth + kAside_deg;
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
  CLI::Option* levels = add(
      command
          .add_option("--to-lod", arguments.lods, "Likewise each level of detail, such as 2.0,1.2")
          ->delimiter(','));
  CLI::Option* explained = add(command.add_option(
      "--explain", arguments.explained,
      "Show a feature, by its id or name, with what it is part of, what is near it, and why it has "
      "its label; seen from where it looks"));
  explained->check(names_a_feature);
  CLI::Option* compared = add(command
                                  .add_option("--compare", arguments.truth_files,
                                              "A truth file, as `score --truth` reads it: mark "
                                              "what is right, wrong and missed (repeatable)")
                                  ->type_name("FILE")
                                  ->allow_extra_args(false));
  // Scales and levels of detail may stand in one strip.
  CLI::Option* after = command.get_option("--after");
  for (CLI::Option* strip : {scales, levels}) {
    exclude_each_other({strip, grid, after, explained});
    exclude_each_other({strip, after, explained, compared});
  }
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
  arguments.looks_from_default =
      options.view == PictureView::oblique && options.azimuth_deg == PictureOptions{}.azimuth_deg;
  options.has_legend = !arguments.has_no_legend;
}

bool settle_targets(PictureArguments& arguments, const RuleBase& rules, Report& report) {
  for (const double scale : scales_of(arguments.scale_texts, "--scales"))
    arguments.targets.push_back(at_scale(scale));
  if (arguments.lods.empty()) return true;
  TargetArguments asked;
  asked.lods = arguments.lods;
  auto levels = targets_of(asked, rules, false, report);
  if (!levels) return false;
  for (Profile& profile : levels->profiles)
    arguments.targets.emplace_back().profiles.push_back(std::move(profile));
  return true;
}

ExitCode read_truth(PictureArguments& arguments, Report& report) {
  ExitCode code = ExitCode::clean;
  for (const std::string& path : arguments.truth_files) {
    auto truths = read_truths(path);
    report.add(truths.issues);
    if (has_errors(truths.issues)) code = ExitCode::input;
    if (!truths.value) continue;
    for (GroundTruth& truth : *truths.value) {
      std::string building = truth.building;
      if (arguments.truths.try_emplace(building, std::move(truth)).second) continue;
      throw CLI::ValidationError(
          "--compare", fmt::format("the building '{}' has two truths; the second is in {}",
                                   printable(building), path));
    }
  }
  return code;
}

std::vector<Issue> PictureExhibit::add(const Document& document, const Building& building,
                                       const PipelineResult& result) {
  if (!arguments_.explained.empty()) {
    add_explained(building, result);
    return {};
  }
  // Pages of a PDF have room for all.
  if (format_ != PictureFormat::pdf && arguments_.most_panels &&
      panels_.size() >= *arguments_.most_panels) {
    ++left_out_;
    return {};
  }
  if (!arguments_.targets.empty()) {
    std::vector<Issue> issues;
    auto panels = target_panels(document, building, result, rules_, arguments_.targets, options_,
                                static_cast<int>(panels_.size()), issues);
    std::ranges::move(panels, std::back_inserter(panels_));
    return issues;
  }
  const bool has_own_panel = arguments_.most_panels.has_value();
  if (has_own_panel || panels_.empty())
    panels_.push_back({.caption = has_own_panel ? building.id : std::string()});
  add_to(panels_.back(), building, result);
  return {};
}

void PictureExhibit::add_to(PicturePanel& panel, const Building& building,
                            const PipelineResult& result) {
  const auto truth = arguments_.truths.find(building.id);
  std::string sentence = "without truth";
  if (truth == arguments_.truths.end()) {
    append_labelled(panel, building, result, rules_, options_);
    ++without_truth_;
  } else {
    const ComparedCounts counts =
        append_compared(panel, building, result, rules_, options_, truth->second);
    sentence = counts.text();
    compared_ += counts;
    ++with_truth_;
  }
  if (!arguments_.truth_files.empty() && !panel.caption.empty()) panel.caption += '\n' + sentence;
}

void PictureExhibit::add_explained(const Building& building, const PipelineResult& result) {
  if (!result.is_done()) return;
  const auto feature = choice_.look(result);
  if (!feature || !panels_.empty()) return;
  panels_ = explained_panels(building, result, rules_, options_, *feature);
  if (arguments_.looks_from_default)
    look_at(result.description.table, *feature, arguments_.options);
}

void PictureExhibit::begin_after(const std::string& file) {
  has_after_ = true;
  panels_.front().caption = before_;
  panels_.front().frame = 0;
  panels_.push_back({.caption = std::filesystem::path(file).filename().string(), .frame = 0});
}

void PictureExhibit::add_after(const Building& building, const PipelineResult& result,
                               const CarriedLabels* carried) {
  PicturePanel& panel = panels_.back();
  if (carried == nullptr)
    append_labelled(panel, building, result, rules_, options_);
  else
    append_building(panel.mesh, building, labelled_as(building, *carried));
}

void PictureExhibit::check(ExitCode code) const {
  if (!arguments_.explained.empty()) choice_.check(code);
  if (arguments_.truth_files.empty() || with_truth_ > 0) return;
  Issue none;
  none.code = Code::E128;
  none.sentence = "has none of the buildings that are shown";
  none.place.file = arguments_.truth_files.front();
  throw InputError(std::move(none));
}

std::string PictureExhibit::made() {
  if (left_out_ > 0)
    run_log().info("--grid {} has no room for {}", arguments_.grid,
                   counted(left_out_, "more building"));
  if (with_truth_ > 0) run_log().info("compared with the truth: {}", compared_.text());
  if (with_truth_ > 0 && without_truth_ > 0)
    run_log().info("{} not in the truth: nothing is marked there",
                   counted(without_truth_, "building is", "buildings are"));
  PictureOptions& options = arguments_.options;
  options.panels_of_page = arguments_.most_panels.value_or(0);
  const std::size_t of_one = arguments_.targets.size() + 1;
  if (of_one > 1 && panels_.size() > of_one) {
    options.columns = static_cast<int>(of_one);
    options.panels_of_page = of_one;
  }
  if (has_after_) mark_changes(panels_);
  Checked<std::string> drawn = picture(panels_, format_, options);
  if (!drawn.value) throw InputError(std::move(drawn.issues.front()));
  return std::move(*drawn.value);
}

}  // namespace oriel::cli
