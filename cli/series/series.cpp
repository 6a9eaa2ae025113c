#include "cli/series/series.h"

#include "cli/batch/run.h"
#include "cli/series/series_files.h"
#include "cli/terminal/logging.h"
#include "kernel/io/files/output_file.h"
#include "kernel/io/records/operation_log.h"
#include "oriel/series.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

class SeriesWriter {
 public:
  SeriesWriter(const LabelArguments& arguments, const std::vector<double>& scales,
               std::optional<Profile> profile, const RuleBase& rules, Run& run, Report& report)
      : arguments_(arguments),
        scales_(scales),
        rules_(rules),
        run_(run),
        report_(report),
        files_(arguments, scales),
        labels_(labels_only(arguments)),
        outputs_(labels_, rules) {
    static_cast<LabelOptions&>(options_) = labels_.label_options();
    options_.profile = std::move(profile);
  }

  ExitCode go() {
    Run::Visitor visitor;
    visitor.begin = [&](std::size_t input) {
      files_.begin(input, !run_.is_last_run());
      outputs_.begin(input, !run_.is_last_run());
      if (input == 0) operations_ = 0;
    };
    visitor.record = [&](const Document& document, std::vector<PipelineResult>& lines) {
      add_record(document, lines);
    };
    visitor.end = [&](std::size_t) {
      run_.timings().measure(Stage::write, [&] {
        files_.end();
        outputs_.end();
      });
    };
    visitor.commit = [&] {
      files_.commit();
      outputs_.commit();
    };
    const ExitCode code = run_.go(visitor);
    run_.tell_summary(fmt::format("made {} levels of", scales_.size()),
                      {{"operation", operations_}}, " in the log");
    return code;
  }

 private:
  /// What the files of a series are called is no file to be written.
  static LabelArguments labels_only(LabelArguments arguments) {
    arguments.out.clear();
    return arguments;
  }

  void add_record(const Document& document, const std::vector<PipelineResult>& lines) {
    options_.observer = run_.timings().observer();
    const Series made = series(document, lines, rules_, scales_, options_);
    for (const Issue& issue : made.issues)
      if (issue.severity == Severity::error)
        run_.set_aside(issue);
      else
        report_.tell(issue);
    std::vector<OutputRecord> levels;
    std::string log;
    run_.timings().measure(Stage::generalise, [&] {
      for (const double scale : scales_) levels.push_back(at(made, scale));
      for (const SeriesOperation& operation : made.operations()) log += operation_line(operation);
    });
    run_.timings().measure(Stage::write, [&] {
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
      run_.set_aside(building_issue(Severity::error, "E207", building, sentence));
    if (!made.drawn.empty()) return;
    Issue issue = building_issue(Severity::error, "E207", "", sentence);
    issue.place.file = document.name;
    run_.set_aside(issue);
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
  Run& run_;
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
  Run run(arguments, &rules, report);
  return SeriesWriter(arguments, scales, std::move(profile), rules, run, report).go();
}

ExitCode write_level_at(const std::string& name, double scale, const std::string& out,
                        Report& report) {
  std::optional<OutputFile> whole;
  const auto file = [&]() -> OutputFile& { return whole ? *whole : whole.emplace(out); };
  const LevelFromFiles level = at(name, scale, [&](std::string_view text) { file().append(text); });
  report.tell(level.issues);
  if (!level.is_complete) return ExitCode::input;
  file().commit();
  run_log().info("1:{} from {}", scale, level.from_file);
  return ExitCode::clean;
}

}  // namespace oriel::cli
