#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/streams/shards.h"
#include "cli/streams/stream_lines.h"
#include "cli/terminal/option_values.h"
#include "io/cityjson/stream_header.h"
#include "io/files/output_file.h"
#include "kernel/base/text/counted.h"

#include <cmath>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// What shards hold in memory together before they are written.
constexpr std::size_t kMostInMemory = 64U << 20U;

struct SplitArguments : RunOptions {
  std::string folder;
  std::uint64_t count = 0, bytes = 0;  ///< 0: not asked for
  double grid_m = 0;
};

/// Features go to shards as they come. With --count and --bytes a shard is a stretch of the stream,
/// with --grid it is what lies in a cell; cells are numbered as they first occur.
class Splitter final : public VisitingCommand {
 public:
  explicit Splitter(const SplitArguments& arguments)
      : arguments_(arguments),
        lines_({[&](const std::string& line) { add_header(line); },
                [&](const std::string& line) { add_feature(line); }},
               arguments.selection) {}

  void name_files(NamedFiles& files) const override {
    const std::filesystem::path folder(arguments_.folder);
    files.add_output("-o", (folder / kShardList).string());
    for (const std::string& input : arguments_.inputs)
      if (is_in(folder, input)) files.add_output("-o", input);
  }
  [[nodiscard]] std::size_t other_features() const override { return lines_.features(); }
  void begin(std::size_t input) override {
    lines_.begin();
    input_ = input;
  }
  void visit(const Document& document, std::vector<PipelineResult>& results) override {
    lines_.add(document, results);
  }
  void commit() override {
    for (ShardFile& file : open_) list_.shards.push_back(file.commit());
    if (header_.empty()) return;
    make_folder();  // there may be no shard
    write_file((std::filesystem::path(arguments_.folder) / kShardList).string(), list_.json());
  }

  [[nodiscard]] std::size_t shards() const { return list_.shards.size(); }

 private:
  /// Shards would take its name, or might.
  static bool is_in(const std::filesystem::path& folder, const std::string& input) {
    const std::string name = std::filesystem::path(input).filename().string();
    std::error_code error;
    return name.find_first_not_of("0123456789") == name.find('.') &&
           std::filesystem::equivalent(folder / name, input, error);
  }

  using GridCell = std::pair<std::int64_t, std::int64_t>;

  void add_header(const std::string& line) {
    if (const auto issue = headers_.check(line, arguments_.inputs[input_]))
      throw InputError(*issue);
    if (!header_.empty()) return;
    header_ = line;
    place_.emplace(line);
  }

  void add_feature(const std::string& line) {
    ShardFile& shard = arguments_.grid_m > 0 ? shard_of(cell_of(line)) : next_shard(line.size());
    shard.append(line);
    in_memory_ += line.size();
    if (in_memory_ < kMostInMemory) return;
    for (ShardFile& file : open_) file.flush();
    in_memory_ = 0;
  }

  /// The shard at hand, or a new one if it is full.
  ShardFile& next_shard(std::size_t bytes) {
    const bool is_full =
        (arguments_.count > 0 && features_ >= arguments_.count) ||
        (arguments_.bytes > 0 && features_ > 0 && bytes_ + bytes > arguments_.bytes);
    if (open_.empty() || is_full) {
      if (!open_.empty()) list_.shards.push_back(open_.back().commit());
      open_.clear();
      begin_shard();
      features_ = bytes_ = 0;
    }
    ++features_;
    bytes_ += bytes;
    return open_.back();
  }

  ShardFile& shard_of(GridCell cell) {
    const auto [found, is_new] = number_of_.try_emplace(cell, open_.size());
    if (is_new) begin_shard();
    return open_[found->second];
  }
  /// Features without vertices go with the cell of the origin.
  [[nodiscard]] GridCell cell_of(const std::string& line) const {
    const Vec3 middle = place_->middle_of(line).value_or(Vec3{});
    return {static_cast<std::int64_t>(std::floor(middle.x / arguments_.grid_m)),
            static_cast<std::int64_t>(std::floor(middle.y / arguments_.grid_m))};
  }

  void make_folder() const {
    std::error_code error;
    std::filesystem::create_directories(arguments_.folder, error);  // shows when it is opened
  }

  void begin_shard() {
    make_folder();
    open_.emplace_back(arguments_.folder, fmt::format("{:06}", begun_++));
    open_.back().append(header_);
  }

  const SplitArguments& arguments_;
  StreamLines lines_;
  CommonHeader headers_;
  std::string header_;
  std::optional<FeaturePlace> place_;
  std::deque<ShardFile> open_;
  std::map<GridCell, std::size_t> number_of_;
  ShardList list_;
  std::size_t input_ = 0, begun_ = 0, in_memory_ = 0;
  std::uint64_t features_ = 0, bytes_ = 0;  ///< of the shard at hand
};

ExitCode work(SplitArguments& arguments) {
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  BatchRunner runner(arguments, nullptr, report);
  Splitter command(arguments);
  const ExitCode code = runner.run(command);
  runner.report_summary("split into " + counted(command.shards(), "shard"), {});
  return code;
}

}  // namespace

void add_split(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<SplitArguments>();
  arguments->ends_at_reading = true;
  CLI::App* command = app.add_subcommand("split",
                                         "Split a stream into shards, each a CityJSONSeq with its "
                                         "header, and list them in split.json");
  add_input_arguments(*command, *arguments, true);
  command->add_option("-o,--output", arguments->folder, "Folder for the shards and split.json")
      ->required();
  CLI::Option_group* by = command->add_option_group("By");
  by->add_option("--count", arguments->count, "Features per shard")->check(above_zero());
  by->add_option("--bytes", arguments->bytes,
                 "Most bytes of features per shard, unless one feature alone is larger")
      ->check(above_zero());
  by->add_option("--grid", arguments->grid_m,
                 "Side of a grid cell, in metres; each cell makes one shard")
      ->check(above_zero());
  by->require_option(1);
  add_run_arguments(*command, *arguments);
  command->remove_option(command->get_option("--repeat"));
  command->footer("Example:\n  oriel split city.city.jsonl --count 10000 -o shards/");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
