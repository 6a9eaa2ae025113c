#include "cli/output/series_output.h"

#include "cli/batch/arena.h"
#include "cli/batch/batch_runner.h"
#include "cli/options/options.h"
#include "cli/output/output_sink.h"
#include "cli/streams/stream_lines.h"
#include "cli/terminal/logging.h"
#include "io/cityjson/cityjson_collector.h"
#include "io/files/output_file.h"
#include "io/files/partial_files.h"
#include "io/records/log_seal.h"
#include "io/records/operation_log.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "oriel/generalise.h"
#include "oriel/series.h"
#include "oriel/write.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

Format format_of_input(const LabellingArguments& arguments, const std::string& input) {
  if (const auto format = arguments.read_options(input).format) return *format;
  return format_of(input).value_or(Format::cityjson);
}

void check_outputs(const LabellingArguments& arguments) {
  if (arguments.out == "-" || arguments.out.ends_with('/'))
    refuse_usage("-o", Code::G414, "the files of a series need a name: -o NAME");
  if (!arguments.to.empty())
    refuse_usage("--to", Code::G414,
                 "the levels of a series are CityJSON files, or streams if the inputs are streams");
  if (arguments.is_isolated || !arguments.reuse.empty() || arguments.is_resumable)
    refuse_usage("--series", Code::G414,
                 "does not work with --isolate, --reuse and --resume, which are for one scale");
}

/// The files of a series: one for each scale, and the log. They appear when all inputs are done.
///
/// - Of one input that is no stream, NAME.1-N.city.json, where all else stays byte for byte.
/// - Of several such, one CityJSON file, held in memory; with grids of their own they get one of
///   micrometres, made coarser if all vertices allow it.
/// - Of streams, NAME.1-N.city.jsonl under the header of the first, line by line.
class SeriesFiles {
 public:
  /// `scales` ascend. Refuses with G414 (refuse_usage) what makes no series.
  SeriesFiles(const LabellingArguments& arguments, const std::vector<double>& scales);

  /// Adds the levels and the log.
  void name_files(NamedFiles& files) const;
  /// Before the first record of an input; with `is_rehearsal` nothing is kept.
  void begin(std::size_t input, bool is_rehearsal);
  /// A record at all scales, and its lines of the log (operation_line). Adds nothing if it has the
  /// id of a CityObject that an earlier input had, and returns that. Throws InputError E116 if its
  /// input does not go with the first.
  std::optional<std::string> add(const Document& document, const std::vector<OutputRecord>& levels,
                                 const std::string& lines);
  void end();
  void commit();

 private:
  enum class Kind { one_file, several_files, streams };
  struct Level {
    std::unique_ptr<OutputSink> destination;  ///< of one file
    std::unique_ptr<OutputFile> file;
    CityJsonCollector collector;
  };

  static Kind kind_of(const LabellingArguments& arguments);
  [[nodiscard]] std::string path_of(double scale) const;
  [[nodiscard]] std::map<std::string, std::string> hashes() const;
  void check_header(const std::string& header, const Document& document);
  [[nodiscard]] std::optional<std::string> twin(const Document& document,
                                                const std::vector<std::string>& texts) const;
  void add_text(Level& level, const std::string& text, bool is_header) const;

  const LabellingArguments& arguments_;
  const std::vector<double>& scales_;
  Kind kind_;
  std::vector<Level> levels_;  ///< by scale
  std::unique_ptr<OutputFile> log_;
  LogSealer sealer_;
  CommonHeader headers_;
  std::unordered_set<std::string> ids_;  ///< of buildings, of several inputs
  std::size_t input_ = 0;
  bool is_first_ = true;    ///< record of the input
  bool has_ended_ = false;  ///< an input did
};

SeriesFiles::Kind SeriesFiles::kind_of(const LabellingArguments& arguments) {
  const auto streams = std::ranges::count_if(arguments.inputs, [&](const std::string& input) {
    return format_of_input(arguments, input) == Format::cityjson_seq;
  });
  if (streams == 0) return arguments.inputs.size() == 1 ? Kind::one_file : Kind::several_files;
  if (std::cmp_not_equal(streams, arguments.inputs.size()))
    refuse_usage("input", Code::G414,
                 "streams and files cannot form one series: oriel cat turns files into streams");
  return Kind::streams;
}

SeriesFiles::SeriesFiles(const LabellingArguments& arguments, const std::vector<double>& scales)
    : arguments_(arguments),
      scales_(scales),
      kind_(kind_of(arguments)),
      levels_(scales.size()),
      headers_(kind_ == Kind::streams ? CommonHeader::Of::stream : CommonHeader::Of::file) {
  check_outputs(arguments);
}

void SeriesFiles::name_files(NamedFiles& files) const {
  const std::string loss = "a series would keep only what is drawn of it";
  for (const double scale : scales_) files.add_output("-o", path_of(scale), loss);
  files.add_output("-o", arguments_.out + ".oplog.jsonl", loss);
}

std::string SeriesFiles::path_of(double scale) const {
  return fmt::format("{}.1-{}.city.json{}", arguments_.out, scale,
                     kind_ == Kind::streams ? "l" : "");
}

void SeriesFiles::begin(std::size_t input, bool is_rehearsal) {
  input_ = input;
  is_first_ = true;
  if (input > 0 && log_) {
    for (Level& level : levels_)
      if (level.destination) level.destination->begin(input, is_rehearsal);
    return;
  }
  ids_.clear();
  sealer_ = {};
  headers_ =
      CommonHeader(kind_ == Kind::streams ? CommonHeader::Of::stream : CommonHeader::Of::file);
  const auto path = [&](const std::string& name) { return is_rehearsal ? "/dev/null" : name; };
  log_ = std::make_unique<OutputFile>(path(arguments_.out + ".oplog.jsonl"));
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    levels_[i] = {};
    if (kind_ == Kind::one_file) {
      levels_[i].destination = std::make_unique<OutputSink>(
          path_of(scales_[i]), "cityjson", arguments_.inputs, arguments_.read_options().format);
      levels_[i].destination->begin(input, is_rehearsal);
    } else {
      levels_[i].file = std::make_unique<OutputFile>(path(path_of(scales_[i])));
    }
  }
}

std::optional<std::string> SeriesFiles::twin(const Document& document,
                                             const std::vector<std::string>& texts) const {
  for (const Building& building : document.buildings)
    if (ids_.contains(building.id)) return building.id;
  if (kind_ == Kind::streams) return std::nullopt;
  for (std::size_t i = 0; i < texts.size(); ++i)
    if (!texts[i].empty())
      if (auto id = levels_[i].collector.twin_in(texts[i])) return id;
  return std::nullopt;
}

/// The header of an input, or the whole of it.
void SeriesFiles::check_header(const std::string& header, const Document& document) {
  const std::string& input = arguments_.inputs[input_];
  if (const auto issue = headers_.check(header, input)) throw InputError(*issue);
  if (kind_ != Kind::streams || input_ == 0 || document.buildings.empty()) return;
  Issue issue;
  issue.code = Code::G414;
  issue.sentence =
      "has buildings in its header, which only the first stream may have: oriel cat turns them "
      "into lines";
  issue.place.file = input;
  throw InputError(std::move(issue));
}

void SeriesFiles::add_text(Level& level, const std::string& text, bool is_header) const {
  if (kind_ == Kind::streams) {
    if (!is_header || input_ == 0) level.file->append(text);
  } else if (is_header) {
    level.collector.add_file(text);
  } else {
    level.collector.add(text);
  }
}

std::optional<std::string> SeriesFiles::add(const Document& document,
                                            const std::vector<OutputRecord>& levels,
                                            const std::string& lines) {
  const bool is_header = std::exchange(is_first_, false);
  std::vector<std::string> texts;
  if (kind_ != Kind::one_file)
    for (const OutputRecord& level : levels) texts.push_back(write(document, level));
  if (is_header && !texts.empty()) check_header(texts[0], document);
  if (auto id = twin(document, texts)) return id;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    if (kind_ == Kind::one_file)
      levels_[i].destination->add(document, levels[i]);
    else
      add_text(levels_[i], texts[i], is_header);
  }
  if (arguments_.inputs.size() > 1)
    for (const Building& building : document.buildings) ids_.insert(building.id);
  log_->append(sealer_.sealed(lines));
  return std::nullopt;
}

void SeriesFiles::end() {
  has_ended_ = true;
  for (Level& level : levels_)
    if (level.destination) level.destination->end();
}

void SeriesFiles::commit() {
  if (!has_ended_) return;
  for (Level& level : levels_) {
    if (!level.file) continue;
    if (kind_ == Kind::several_files) level.file->append(level.collector.text());
    level.file->commit();
  }
  log_->append(sealer_.end(hashes()));
  log_->commit();
}

/// Of the levels, which are in their places.
std::map<std::string, std::string> SeriesFiles::hashes() const {
  constexpr auto kWhole = std::numeric_limits<std::uint64_t>::max();
  std::map<std::string, std::string> hashes;
  for (const double scale : scales_)
    hashes[fmt::format("{}", scale)] = PartialFiles::mark_of(path_of(scale), kWhole).sha256;
  return hashes;
}

class SeriesWriter final : public VisitingCommand {
 public:
  SeriesWriter(const LabellingArguments& arguments, const std::vector<double>& scales,
               std::optional<Profile> profile, const RuleBase& rules, BatchRunner& runner,
               Report& report)
      : arguments_(arguments),
        scales_(scales),
        rules_(rules),
        runner_(runner),
        report_(report),
        files_(arguments, scales),
        labels_(labels_only(arguments)),
        outputs_(labels_, rules) {
    static_cast<LabelOptions&>(options_) = labels_.label_options();
    options_.profile = std::move(profile);
    if (!options_.neighbours || !options_.profile) return;
    for (const double scale : scales)
      options_.groups.push_back(
          asks_for_groups(*options_.profile, scale)
              ? std::make_shared<CityGroups>(*options_.neighbours, *options_.profile, scale,
                                             shares_in_arena(arguments.jobs), arguments.kept.get())
              : nullptr);
  }

  void name_files(NamedFiles& files) const override {
    files_.name_files(files);
    outputs_.name_files(files);
  }
  void begin(std::size_t input) override {
    files_.begin(input, !runner_.is_last_run());
    outputs_.begin(input, !runner_.is_last_run());
    if (input > 0) return;
    operations_ = 0;
    drawn_.clear();
  }
  void visit(const Document& document, std::vector<PipelineResult>& results) override {
    add_record(document, results);
  }
  void end(std::size_t /*input*/) override {
    runner_.timings().measure(Stage::write, [&] {
      files_.end();
      outputs_.end();
    });
  }
  void commit() override {
    files_.commit();
    outputs_.commit();
  }

  [[nodiscard]] int operations() const { return operations_; }
  /// Features of the buildings that are in the series, by label.
  [[nodiscard]] const std::map<std::string, int>& drawn() const { return drawn_; }

 private:
  /// What the files of a series are called is no file to be written.
  static LabellingArguments labels_only(LabellingArguments arguments) {
    arguments.out.clear();
    return arguments;
  }

  void add_record(const Document& document, const std::vector<PipelineResult>& lines) {
    options_.observer = runner_.timings().observer();
    const Series made = series(document, lines, rules_, scales_, options_);
    for (const Issue& issue : made.issues)
      if (issue.severity == Severity::error)
        runner_.set_aside(issue);
      else
        report_.add(issue);
    std::vector<OutputRecord> levels;
    std::string log;
    runner_.timings().measure(Stage::generalise, [&] {
      std::set<std::string> told;  // that overlap at a finer level
      for (const double scale : scales_) {
        levels.push_back(at(made, scale));
        for (const Issue& issue : overlaps_as_written(document, levels.back()))
          if (told.insert(issue.place.building).second) runner_.set_aside(issue);
      }
      for (const SeriesOperation& operation : made.operations()) log += operation_line(operation);
    });
    runner_.timings().measure(Stage::write, [&] {
      const auto twin = files_.add(document, levels, log);
      if (twin) return set_aside_twin(made, document, *twin);
      for (const BuildingSeries& one : made.buildings)
        operations_ += static_cast<int>(one.series.operations.size());
      count_drawn(made, document, lines);
      add_features(document, lines);
    });
  }

  /// Buildings that no levels could be drawn of were set aside before.
  void set_aside_twin(const Series& made, const Document& document, const std::string& id) {
    const std::string sentence =
        fmt::format("an earlier input has a CityObject '{}': that one is in the series", id);
    for (const std::string& building : made.drawn)
      runner_.set_aside(building_issue(Severity::error, Code::E207, building, sentence));
    if (!made.drawn.empty()) return;
    Issue issue = building_issue(Severity::error, Code::E207, "", sentence);
    issue.place.file = document.name;
    runner_.set_aside(issue);
  }

  void count_drawn(const Series& made, const Document& document,
                   const std::vector<PipelineResult>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (std::ranges::find(made.drawn, document.buildings[i].id) == made.drawn.end()) continue;
      for (const auto& [label, count] : count_labels(lines[i].interpretation))
        drawn_[label] += count;
    }
  }

  void add_features(const Document& document, const std::vector<PipelineResult>& lines) {
    if (arguments_.features.empty()) return;
    Product product;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].is_done()) outputs_.make_features(document.buildings[i], lines[i], product);
    outputs_.take(document, product);
  }

  const LabellingArguments& arguments_;
  const std::vector<double>& scales_;
  const RuleBase& rules_;
  BatchRunner& runner_;
  Report& report_;
  SeriesFiles files_;
  LabellingArguments labels_;
  LabelOutputs outputs_;
  SeriesOptions options_;
  int operations_ = 0;
  std::map<std::string, int> drawn_;
};

}  // namespace

ExitCode write_series(const LabellingArguments& arguments, const std::vector<double>& scales,
                      std::optional<Profile> profile, const RuleBase& rules, Report& report) {
  BatchRunner runner(arguments, &rules, report);
  SeriesWriter command(arguments, scales, std::move(profile), rules, runner, report);
  const ExitCode code = runner.run(command);
  report.add(report_untyped(command.drawn(), rules));
  runner.report_summary("drawn at " + counted(scales.size(), "scale"),
                        {{std::string(agreeing(command.operations(), "operation", "operations")),
                          command.operations()}},
                        " in the log");
  return code;
}

ExitCode write_level_at(const std::string& name, double scale, const std::string& out,
                        Report& report) {
  NamedFiles files;
  for (const std::string& file : files_of_series(name)) files.add_input("--from", file);
  files.add_output("-o", out);
  files.check();
  std::optional<OutputFile> whole;
  const auto file = [&]() -> OutputFile& { return whole ? *whole : whole.emplace(out); };
  const LevelFromFiles level = at(name, scale, [&](std::string_view text) { file().append(text); });
  report.add(level.issues);
  if (!level.is_complete) return ExitCode::input;
  file().commit();
  run_log().info("1:{} from {}", scale, printable(level.from_file));
  return ExitCode::clean;
}

ExitCode check_stored_series(const std::string& name, Report& report) {
  const SeriesCheck check = check_series(name);
  report.add(check.issues);
  if (!check.holds) return ExitCode::input;
  fmt::print("{}: {} and the log are one series: {} of {} lead from each to the next and back\n",
             printable(name), counted(check.scales.size(), "level"),
             counted(check.operations, "operation"), counted(check.buildings, "building"));
  return ExitCode::clean;
}

}  // namespace oriel::cli
