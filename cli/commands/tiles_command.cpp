#include "cli/batch/batch_command.h"
#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/batch/inputs/neighbours.h"
#include "cli/batch/rules_choice.h"
#include "cli/batch/run_options.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/option_values.h"
#include "cli/tiles/tiles_page.h"
#include "io/files/output_file.h"
#include "io/files/partial_files.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "oriel/rules.h"
#include "oriel/tiles.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

/// What `oriel tiles` is to write.
struct TilesArguments : RunOptions, RulesChoice {
  std::string folder;
  TilesetOptions tileset;
  std::optional<Profile> profile;
  /// index.html, which shows the tiles, is written, too.
  bool has_viewer = false;
};

namespace fs = std::filesystem;

constexpr const char* kBuildingsName = "buildings.part";
constexpr const char* kTilesetName = "tileset.json";
constexpr const char* kTilesName = "tiles";
constexpr const char* kPageName = "index.html";

/// What a run may leave in its folder: the tiles it has made, the buildings, under whatever name
/// for the time being, and the page.
bool is_leftover(const fs::path& path) {
  const std::string name = path.filename();
  if (name == kPageName) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {}) == tiles_page();
  }
  return name == kTilesName || name.starts_with(kBuildingsName) ||
         name.starts_with(std::string(kTilesetName) + ".") ||
         name.starts_with(std::string(kPageName) + ".");
}

class Tiler final : public ProducingCommand {
 public:
  Tiler(const TilesArguments& arguments, const RuleBase& rules, BatchRunner& runner, Report& report)
      : arguments_(arguments), rules_(rules), runner_(runner), report_(report) {}
  /// Nothing is left of a run that came to nothing, but for what it may go on with.
  ~Tiler() override {
    file_.reset();
    if (has_made_folder_) remove(arguments_.folder);  // which fails if anything is in it
  }
  Tiler(const Tiler&) = delete;
  Tiler& operator=(const Tiler&) = delete;

  void name_files(NamedFiles& files) const override {
    files.add_input("--rules", arguments_.rules);
    files.add_output("-o", path_of(kTilesetName));
    files.add_output("-o", path_of(kBuildingsName));
    if (arguments_.has_viewer) files.add_output("-o", path_of(kPageName));
  }
  void begin(std::size_t input) override {
    if (input == 0 || !file_) open(!runner_.is_last_run());
  }
  std::unique_ptr<ProductMaker> maker(std::size_t /*input*/, const Document& document,
                                      Timings& timings) const override {
    return std::make_unique<Maker>(*this, document, timings);
  }
  void take(const Document& /*document*/, Product product) override {
    file_->append(product[OutputPart::buildings]);
  }
  void commit() override {
    if (!file_) return;
    const std::string path = path_of(kBuildingsName);
    try {
      file_->commit();
      file_.reset();
      PartialFiles::take_done();  // it does not stay
      write_from(path);
    } catch (...) {
      if (!PartialFiles::are_kept()) remove_all(path);
      throw;
    }
    if (written_)
      remove(path);
    else
      remove_all(path);
  }
  void reopen() override { open(false); }

  [[nodiscard]] PartPlaces places() const override {
    PartPlaces places;
    places[static_cast<std::size_t>(OutputPart::buildings)] = {path_of(kBuildingsName),
                                                               file_ ? file_->size() : 0};
    return places;
  }
  [[nodiscard]] std::string recipe() const override {
    const TilesetOptions& tileset = arguments_.tileset;
    return fmt::format(
        "tiles scales={} profile={} crs={} most={} colours={} outlines={} viewer={} "
        "compress={} gzip={}",
        fmt::join(tileset.scales, ","), arguments_.profile ? arguments_.profile->level : "",
        tileset.crs, tileset.most_triangles, static_cast<int>(tileset.glb.colours),
        tileset.glb.has_outlines, arguments_.has_viewer, static_cast<int>(tileset.glb.compression),
        tileset.has_gzip);
  }
  [[nodiscard]] bool is_streaming() const override { return true; }
  [[nodiscard]] bool writes_files() const override { return true; }

  /// What was written; nothing if there was no building.
  [[nodiscard]] const std::optional<TilesetFiles>& written() const { return written_; }

 private:
  class Maker final : public ProductMaker {
   public:
    Maker(const Tiler& of, const Document& document, Timings& timings)
        : of_(of), document_(document), timings_(timings) {
      static_cast<LabelOptions&>(options_) = of.arguments_.label_options(timings.observer());
      options_.profile = of.arguments_.profile;
      options_.has_only_levels = true;
      if (of.arguments_.tileset.glb.colours == GlbColours::by_material)
        colours_ = material_colours(document);
    }
    void add(std::size_t i, PipelineResult result) override {
      if (result.is_passed_over) return;
      const Building& building = document_.buildings[i];
      const std::vector<double>& scales = of_.arguments_.tileset.scales;
      const Series made = series(document_, building, result, of_.rules_, scales, options_);
      product_.issues.insert(product_.issues.end(), made.issues.begin(), made.issues.end());
      timings_.measure(Stage::write, [&] {
        const FaceColours none;
        if (const auto tile =
                tile_building(building, made, scales, colours_.empty() ? none : colours_[i]))
          product_[OutputPart::buildings] += to_bytes(*tile);
      });
    }
    Product finish() override { return std::move(product_); }

   private:
    const Tiler& of_;
    const Document& document_;
    Timings& timings_;
    SeriesOptions options_;
    std::vector<FaceColours> colours_;
    Product product_;
  };

  [[nodiscard]] std::string path_of(const char* name) const {
    return (fs::path(arguments_.folder) / name).string();
  }

  void open(bool is_rehearsal) {
    std::error_code error;
    // What is wrong shows at the file.
    has_made_folder_ |= fs::create_directories(arguments_.folder, error);
    file_ = std::make_unique<OutputFile>(is_rehearsal ? "/dev/null" : path_of(kBuildingsName));
  }

  /// Asks for no memory, which may be used up. If it cannot go it is in nobody's way.
  static void remove(const std::string& path) { std::remove(path.c_str()); }

  /// What this run has made of the buildings in `path`, and these.
  void remove_all(const std::string& path) const {
    remove(path);
    if (arguments_.has_viewer) remove(path_of(kPageName));
    std::error_code error;
    fs::remove_all(fs::path(arguments_.folder) / kTilesName, error);
  }

  void write_from(const std::string& path) {
    const TileBuildings buildings(path);
    if (buildings.entries().empty()) return;
    // The tileset comes last: a folder that has one is whole.
    if (arguments_.has_viewer) write_file(path_of(kPageName), tiles_page());
    auto written = write_tileset(arguments_.folder, buildings, arguments_.tileset);
    if (!written.value) {
      const Issue reason = std::move(written.issues.back());
      written.issues.pop_back();
      report_.add(written.issues);
      throw InputError(reason);
    }
    report_.add(written.issues);
    for (const Issue& issue : written.issues)
      if (issue.severity == Severity::error) runner_.set_aside(issue);
    written_ = std::move(written.value);
  }

  const TilesArguments& arguments_;
  const RuleBase& rules_;
  BatchRunner& runner_;
  Report& report_;
  bool has_made_folder_ = false;
  std::unique_ptr<OutputFile> file_;
  std::optional<TilesetFiles> written_;
};

void tell(const TilesetFiles& written) {
  for (const TilesetFiles::OfScale& of : written.scales)
    run_log().info("1:{}: {}, {}, {:.0f} kB", of.scale, counted(of.tiles, "tile"),
                   counted(of.buildings, "building"), static_cast<double>(of.bytes) / 1000);
}

/// Throws CLI::ValidationError E164 if there are other files in the folder. Those that a run left
/// which was killed are none, nor is what a run with --resume goes on with.
void check_tiles_folder(const TilesArguments& arguments) {
  std::error_code error;
  const fs::path folder(arguments.folder);
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error))
    refuse_usage("-o", Code::E164, printable(arguments.folder) + " is a file, not a folder");
  const std::string& stem = arguments.status_stem;
  const bool goes_on = arguments.is_resumable && (fs::exists(stem + ".journal", error) ||
                                                  fs::exists(stem + ".status.json", error));
  if (goes_on) return;
  const bool is_free = std::ranges::all_of(
      fs::directory_iterator(folder, error),
      [](const fs::directory_entry& entry) { return is_leftover(entry.path()); });
  if (!is_free)
    refuse_usage("-o", Code::E164,
                 printable(arguments.folder) + " is not empty: name another folder");
  fs::remove_all(folder / kTilesName, error);
}

/// `oriel tiles`: the buildings of all inputs, one behind the other, go to FOLDER/buildings.part;
/// when all are there the tiles are made of it, and it is removed.
ExitCode write_tiles(const TilesArguments& arguments, const RuleBase& rules, Report& report) {
  BatchRunner runner(arguments, &rules, report);
  Tiler command(arguments, rules, runner, report);
  const ExitCode code = runner.run(command);
  if (runner.was_done()) return code;
  runner.report_summary("tiled at " + counted(arguments.tileset.scales.size(), "scale"), {});
  if (command.written()) tell(*command.written());
  return code;
}

/// Fewer triangles to a tile would be many files, more would be slow to load.
constexpr std::uint64_t kLeastTriangles = 100, kMostTriangles = 10'000'000;
constexpr int kMostLevels = 100;

struct TilesCall : TilesArguments {
  std::vector<std::string> scale_texts{"1:500", "1:2500", "1:10000", "1:25000"};
  int levels = 0;  ///< 0: the scales that are given
  std::string profile_name;
};

/// The scales that are given, or so many between the first and the last.
std::vector<double> levels_of(const TilesCall& call) {
  const std::vector<double> given = scales_of(call.scale_texts, "--scales");
  if (call.levels == 0) return given;
  if (given.size() < 2)
    refuse_usage("--levels", Code::E125, "needs --scales with the first and the last scale");
  return scales_between(given.front(), given.back(), call.levels);
}

ExitCode work(TilesCall& call) {
  call.only_names_surfaces = true;
  Report report(call.is_verbose);
  settle_inputs(call, report);
  call.tileset.scales = levels_of(call);
  check_tiles_folder(call);
  const auto rules = load_rules(call, report);
  if (!rules) return ExitCode::rules;
  if (!call.profile_name.empty()) {
    auto profile = load_profile_file(call.profile_name);
    report.add(profile.issues);
    if (!profile.value) return ExitCode::rules;
    const auto unfit = check_profile(*profile.value, *rules, ProfileUse::tiles);
    report.add(unfit);
    if (has_errors(unfit)) return ExitCode::rules;
    call.profile = std::move(profile.value);
  }
  find_neighbours(call, report, call.folder);
  return write_tiles(call, *rules, report);
}

void add_tileset_arguments(CLI::App& command, TilesCall& call) {
  command.add_option("-o,--output", call.folder, "Folder of the tileset, which is new or empty")
      ->required();
  command.add_option("--scales", call.scale_texts, "Scales, such as 1:500,1:2500, one level each")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->default_str("1:500,1:2500,1:10000,1:25000");
  command
      .add_option("--levels", call.levels,
                  "So many levels from the first of --scales to the last, in equal ratios")
      ->check(count_in(2, kMostLevels));
  command.add_option("--profile", call.profile_name,
                     "What to do with features that the pack has no entry for: NAME[:LEVEL] or a "
                     "file (default: they stay)");
  command.add_option("--crs", call.tileset.crs,
                     "Coordinate reference system of the input, such as EPSG:7415; local: a frame "
                     "of its own (default: what the input names)");
  command
      .add_option_function<std::string>(
          "--colours",
          [&call](const std::string& by) {
            call.tileset.glb.colours = by == "label"      ? GlbColours::by_label
                                       : by == "surface"  ? GlbColours::by_surface
                                       : by == "material" ? GlbColours::by_material
                                                          : GlbColours::none;
          },
          "Colours of the faces: by label, by type of surface, by the input's material, or none")
      ->check(one_of({"label", "surface", "material", "none"}))
      ->default_str("label");
  command.add_flag("--viewer", call.has_viewer,
                   "Write index.html, too: a page that shows the tiles, from any file server");
  command.add_flag("--outlines", call.tileset.glb.has_outlines, "Draw edges as lines, too");
  command
      .add_option_function<std::string>(
          "--compress",
          [&call](const std::string& by) {
            call.tileset.glb.compression =
                by == "meshopt" ? GlbCompression::meshopt : GlbCompression::none;
          },
          "How vertices and triangles are compressed; nothing is lost")
      ->check(one_of({"none", "meshopt"}))
      ->default_str("none");
  command.add_flag("--gzip", call.tileset.has_gzip,
                   "Every file is a gzip archive under its own name, for servers that send "
                   "Content-Encoding: gzip");
  command
      .add_option("--most-triangles", call.tileset.most_triangles,
                  "Most triangles of a tile with more than one building")
      ->check(count_in(kLeastTriangles, kMostTriangles))
      ->capture_default_str();
}

}  // namespace

void add_tiles(CLI::App& app, Action& action) {
  auto call = std::make_shared<TilesCall>();
  CLI::App* command = app.add_subcommand(
      "tiles", "Write 3D Tiles of buildings generalised to several scales, for viewers");
  add_line_arguments(*command, *call, true);
  add_rules_arguments(*command, *call);
  add_tileset_arguments(*command, *call);
  add_neighbours_argument(*command, call->neighbours_of);
  add_resume_argument(*command, *call);
  command->footer(
      "Example:\n  oriel tiles city.city.jsonl -o tiles --scales 1:500,1:2500,1:10000 -j 0");
  command->callback([call, &action] { action = [call] { return work(*call); }; });
}

}  // namespace oriel::cli
