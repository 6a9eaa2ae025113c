#include "cli/series/series.h"

#include "cli/batch/batch_runner.h"
#include "cli/series/series_files.h"
#include "cli/terminal/logging.h"
#include "kernel/io/files/output_file.h"
#include "kernel/io/records/operation_log.h"
#include "oriel/series.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

class SeriesWriter final : public VisitingCommand {
 public:
  SeriesWriter(const LabelArguments& arguments, const std::vector<double>& scales,
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
  }

  void begin(std::size_t input) override {
    files_.begin(input, !runner_.is_last_run());
    outputs_.begin(input, !runner_.is_last_run());
    if (input == 0) operations_ = 0;
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

 private:
  /// What the files of a series are called is no file to be written.
  static LabelArguments labels_only(LabelArguments arguments) {
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
      for (const double scale : scales_) levels.push_back(at(made, scale));
      for (const SeriesOperation& operation : made.operations()) log += operation_line(operation);
    });
    runner_.timings().measure(Stage::write, [&] {
      const auto twin = files_.add(document, levels, log);
      if (twin) return set_aside_twin(made, document, *twin);
      for (const BuildingSeries& one : made.buildings)
        operations_ += static_cast<int>(one.series.operations.size());
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

  void add_features(const Document& document, const std::vector<PipelineResult>& lines) {
    if (arguments_.features.empty()) return;
    Product product;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].is_done()) outputs_.make_features(document.buildings[i], lines[i], product);
    outputs_.take(document, product);
  }

  const LabelArguments& arguments_;
  const std::vector<double>& scales_;
  const RuleBase& rules_;
  BatchRunner& runner_;
  Report& report_;
  SeriesFiles files_;
  LabelArguments labels_;
  LabelOutputs outputs_;
  SeriesOptions options_;
  int operations_ = 0;
};

}  // namespace

ExitCode write_series(const LabelArguments& arguments, const std::vector<double>& scales,
                      std::optional<Profile> profile, const RuleBase& rules, Report& report) {
  BatchRunner runner(arguments, &rules, report);
  SeriesWriter command(arguments, scales, std::move(profile), rules, runner, report);
  const ExitCode code = runner.run(command);
  runner.report_summary(fmt::format("drawn at {} scales", scales.size()),
                        {{"operation", command.operations()}}, " in the log");
  return code;
}

ExitCode write_level_at(const std::string& name, double scale, const std::string& out,
                        Report& report) {
  std::optional<OutputFile> whole;
  const auto file = [&]() -> OutputFile& { return whole ? *whole : whole.emplace(out); };
  const LevelFromFiles level = at(name, scale, [&](std::string_view text) { file().append(text); });
  report.add(level.issues);
  if (!level.is_complete) return ExitCode::input;
  file().commit();
  run_log().info("1:{} from {}", scale, level.from_file);
  return ExitCode::clean;
}

}  // namespace oriel::cli
