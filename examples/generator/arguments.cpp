#include "examples/generator/arguments.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <ostream>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::generator {
namespace {

constexpr Um kMetre = 1'000'000;
constexpr std::string_view kFooter = R"(
A folder gets NAME.labelled.city.json, NAME.stripped.city.json and NAME.truth.json for each house;
with --format citygml or citygml3, .gml in place of .city.json.
Features: )";

std::string feature_names() {
  std::string names;
  for (std::size_t i = 0; i < kFeatures; ++i) {
    if (i > 0) names += i % 10 == 0 ? ",\n  " : ", ";
    names += name_of(static_cast<Feature>(i));
  }
  return names;
}

double number(std::string_view text, const std::string& option) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    throw CLI::ValidationError(option, "'" + std::string(text) + "' is not a number");
  return value;
}

/// "X" or "A..B", each within [low, high].
Range<double> range(const std::string& text, const std::string& option, double low, double high) {
  const std::size_t dots = text.find("..");
  Range<double> result;
  result.low = number(text.substr(0, dots), option);
  result.high = dots == std::string::npos ? result.low : number(text.substr(dots + 2), option);
  if (result.low < low || result.high > high || result.low > result.high)
    throw CLI::ValidationError(option, "'" + text + "' is not a range within " +
                                           CLI::detail::to_string(low) + " .. " +
                                           CLI::detail::to_string(high));
  return result;
}

Um micrometres(double metres) { return std::llround(metres * static_cast<double>(kMetre)); }

Range<Um> lengths(const std::string& text, const std::string& option) {
  const Range<double> metres = range(text, option, 6, 200);
  return {micrometres(metres.low), micrometres(metres.high)};
}

Point origin(const std::string& text) {
  std::array<double, 3> parts{};
  std::size_t start = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? text.find(',', start) : text.size();
    if (end == std::string::npos)
      throw CLI::ValidationError("--origin", "'" + text + "' is not X,Y,Z in metres");
    parts[i] = number(std::string_view(text).substr(start, end - start), "--origin");
    if (std::abs(parts[i]) > 1e8)
      throw CLI::ValidationError("--origin", "'" + text + "' is farther than 100,000 km away");
    start = end + 1;
  }
  return {micrometres(parts[0]), micrometres(parts[1]), micrometres(parts[2])};
}

FeatureSet features(const std::vector<std::string>& names) {
  FeatureSet set;
  for (const std::string& name : names) {
    const std::optional<Feature> feature = feature_named(name);
    if (!feature)
      throw CLI::ValidationError(
          "--features", "there is no feature '" + name + "'; there are:\n  " + feature_names());
    set.add(*feature);
  }
  return set;
}

std::vector<Addition> additions(const std::vector<std::string>& texts) {
  std::vector<Addition> all;
  try {
    for (const std::string& text : texts) all.push_back(read_addition(text));
  } catch (const AdditionError& error) {
    throw CLI::ValidationError("--add", error.what());
  }
  return all;
}

std::optional<RoofKind> roof(const std::string& name) {
  for (const RoofKind kind : {RoofKind::flat, RoofKind::gable, RoofKind::hip, RoofKind::shed})
    if (name == name_of(kind)) return kind;
  return std::nullopt;
}

std::optional<ChimneyPlace> chimney(const std::string& name) {
  if (name == "slope") return ChimneyPlace::slope;
  if (name == "ridge") return ChimneyPlace::ridge;
  if (name == "apex") return ChimneyPlace::apex;
  return std::nullopt;
}

/// The arguments as they are typed, before they are understood.
struct Typed {
  std::string style = "continental";
  std::string roof = "mixed", chimney = "mixed", storeys, width, depth, origin;
  std::vector<std::string> features{"all"}, additions;
  double jitter_m = 0, noise_mm = 0;
};

void add_options(CLI::App& app, Typed& typed, Arguments& arguments) {
  Options& options = arguments.options;
  app.add_option("-o,--output", arguments.output,
                 "a folder, or one file for all houses: a CityJSONSeq (X.city.jsonl; - for stdout) "
                 "or CityGML (X.gml)")
      ->required();
  app.add_option(
         "--format", arguments.format,
         "cityjson, citygml (2.0) or citygml3; X.gml is CityGML 2.0 unless citygml3 is given")
      ->check(CLI::IsMember({"cityjson", "citygml", "citygml3"}))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "the same options and seed give the same bytes")
      ->capture_default_str();
  app.add_option("--count", arguments.count, "number of houses")
      ->check(CLI::Range(1, 10'000'000))
      ->capture_default_str();
  app.add_option("--name", arguments.name, "id of the house; several are NAME-000001, ...")
      ->capture_default_str();
  app.add_option("--style", typed.style,
                 "continental: single houses, described by the options below; english: terraces, "
                 "pairs, town rows and flats, whose sizes and features are drawn at random; city: "
                 "terraces, blocks around courtyards and single houses along streets, where "
                 "neighbours share walls")
      ->check(CLI::IsMember({"continental", "english", "city"}))
      ->capture_default_str();
  app.add_option("--roof", typed.roof, "flat, gable, hip, shed or mixed")
      ->check(CLI::IsMember({"flat", "gable", "hip", "shed", "mixed"}))
      ->capture_default_str();
  app.add_option("--storeys", typed.storeys, "number of storeys: N or A..B, 1 to 8 (default 1..4)");
  app.add_option("--width", typed.width, "width in metres: X or A..B, 6 to 200 (default 8..18)");
  app.add_option("--depth", typed.depth, "depth in metres: X or A..B, 6 to 200 (default 7..12)");
  app.add_option("--features", typed.features,
                 "features of every house where there is room, separated by commas; all: each "
                 "house draws its own")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option(
         "--add", typed.additions,
         "a block, hole or panel for every house, in metres, such as\n\"solar_panel panel on roof "
         "size 1.7x1x0.06\" or\n\"window hole on front at 2,1 size 1.2x1.4\"; may be "
         "repeated")
      ->allow_extra_args(false);
  app.add_option("--chimney", typed.chimney, "where chimneys stand: slope, ridge, apex or mixed")
      ->check(CLI::IsMember({"slope", "ridge", "apex", "mixed"}))
      ->capture_default_str();
  app.add_option("--flush", options.flush,
                 "share of windows and doors that are flush with their wall")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--jitter", typed.jitter_m, "most metres by which windows are moved and resized")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--windows", options.windows, "about how many windows one house has; 0: as drawn")
      ->check(CLI::Range(0, 5000))
      ->capture_default_str();
  app.add_option("--rotate", options.rotate_deg,
                 "degrees to rotate the houses by, counter-clockwise")
      ->check(CLI::Range(-360.0, 360.0))
      ->capture_default_str();
  app.add_option("--noise", typed.noise_mm, "most millimetres by which each coordinate is moved")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  app.add_flag("--triangulate", options.triangulate, "cut every polygon into triangles");
  app.add_option("--origin", typed.origin,
                 "position of the first house: X,Y,Z in metres, such as 604000,5403766,370");
  app.add_flag("--labelled", arguments.is_labelled,
               "with one file for all houses: write labelled houses, not stripped ones");
  app.add_option(
      "--truth", arguments.truth,
      "with one file for all houses: where to write the truths, a .jsonl file or a folder");
}

/// Other styles refuse what describes a single continental house.
void refuse_unused(const CLI::App& app, std::string_view style) {
  for (const char* option : {"--roof", "--storeys", "--width", "--depth", "--features", "--chimney",
                             "--windows", "--add"})
    if (app.count(option) > 0)
      throw CLI::ValidationError(
          option, fmt::format("is for --style continental; {} houses draw it", style));
}

void understand(const Typed& typed, Arguments& arguments) {
  Options& options = arguments.options;
  for (const Style style : {Style::english, Style::city})
    if (typed.style == name_of(style)) options.style = style;
  options.roof = roof(typed.roof);
  options.chimney = chimney(typed.chimney);
  if (!typed.storeys.empty()) {
    const Range<double> storeys = range(typed.storeys, "--storeys", 1, 8);
    options.storeys = {static_cast<int>(storeys.low), static_cast<int>(storeys.high)};
    options.has_storeys = true;
  }
  if (!typed.width.empty()) options.width = lengths(typed.width, "--width");
  if (!typed.depth.empty()) options.depth = lengths(typed.depth, "--depth");
  if (typed.features != std::vector<std::string>{"all"})
    options.features = features(typed.features);
  options.additions = additions(typed.additions);
  if (!typed.origin.empty()) options.origin = origin(typed.origin);
  options.jitter = micrometres(typed.jitter_m) / 1000 * 1000;
  options.noise = micrometres(typed.noise_mm / 1000);
  if (arguments.is_gml_file() && arguments.format == "cityjson") arguments.format = "citygml";
  const bool is_sequence = arguments.output == "-" || arguments.output.ends_with(".city.jsonl");
  if (is_sequence && arguments.format != "cityjson")
    throw CLI::ValidationError("--format", "CityGML goes to a folder or to X.gml");
  const bool is_stream = is_sequence || arguments.is_gml_file();
  if (!is_stream && (arguments.is_labelled || !arguments.truth.empty()))
    throw CLI::ValidationError(
        "--labelled, --truth",
        "they are for a CityJSONSeq or X.gml; a folder gets all files anyway");
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_';
  };
  const std::string& name = arguments.name;
  const bool is_ncname = !name.empty() && std::all_of(name.begin(), name.end(), is_plain) &&
                         std::isalpha(static_cast<unsigned char>(name[0])) != 0;
  if (!is_ncname)
    throw CLI::ValidationError("--name",
                               "'" + name + "' must be a letter, then letters, digits, - and _");
}

}  // namespace

std::optional<int> read_arguments(int argc, const char* const* argv, Arguments& arguments,
                                  std::ostream& out, std::ostream& err) {
  CLI::App app{"Makes sample buildings with exact ground truth.\n", "oriel-generate"};
  app.footer(std::string(kFooter) + feature_names() +
             "\n\nExample: oriel-generate --seed 7 --roof gable --storeys 2 -o samples\n");
  Typed typed;
  add_options(app, typed, arguments);
  try {
    app.parse(argc, argv);
    understand(typed, arguments);
    if (arguments.options.style != Style::continental) refuse_unused(app, typed.style);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help, out, err);
  } catch (const CLI::ParseError& error) {
    err << "oriel-generate: " << error.what() << "\nTry oriel-generate --help.\n";
    return 2;
  }
  return std::nullopt;
}

}  // namespace oriel::generator
