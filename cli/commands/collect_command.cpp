#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/streams/stream_lines.h"
#include "io/cityjson/cityjson_collector.h"
#include "io/files/output_file.h"

#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct CollectArguments : RunOptions {
  std::string out = "-";
};

/// One CityJSON file of all inputs, under the header of the first.
class Collect final : public VisitingCommand {
 public:
  Collect(const CollectArguments& arguments, BatchRunner& runner)
      : arguments_(arguments),
        runner_(runner),
        lines_({[&](const std::string& line) { add_header(line); },
                [&](const std::string& line) { add_feature(line); }},
               arguments.selection) {}

  void name_files(NamedFiles& files) const override { files.add_output("-o", arguments_.out); }
  [[nodiscard]] std::size_t other_features() const override { return lines_.features(); }
  void begin(std::size_t input) override {
    lines_.begin();
    input_ = input;
    if (input == 0) collector_ = {};
  }
  void visit(const Document& document, std::vector<PipelineResult>& results) override {
    runner_.timings().measure(Stage::write, [&] { lines_.add(document, results); });
  }
  void end(std::size_t /*input*/) override { has_ended_ = true; }
  void commit() override {
    if (has_ended_) write_file(arguments_.out, collector_.text());
  }

 private:
  void add_header(const std::string& line) {
    if (const auto issue = header_.check(line, arguments_.inputs[input_])) throw InputError(*issue);
    if (!collector_.has_lines()) collector_.add(line);
  }
  void add_feature(const std::string& line) {
    const auto twin = collector_.add(line);
    if (!twin) return;
    runner_.set_aside(
        building_issue(Severity::error, Code::E207, *twin,
                       "an earlier feature has a CityObject with this id; that one is "
                       "collected"));
  }

  const CollectArguments& arguments_;
  BatchRunner& runner_;
  StreamLines lines_;
  CommonHeader header_;
  CityJsonCollector collector_;
  std::size_t input_ = 0;
  bool has_ended_ = false;  ///< an input did
};

ExitCode work(CollectArguments& arguments) {
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  BatchRunner runner(arguments, nullptr, report);
  Collect command(arguments, runner);
  check_output_format(arguments, command, arguments.out, Format::cityjson);
  const ExitCode code = runner.run(command);
  runner.report_summary("collected", {});
  return code;
}

}  // namespace

void add_collect(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<CollectArguments>();
  arguments->ends_at_reading = true;
  CLI::App* command =
      app.add_subcommand("collect", "Combine the features of streams into one CityJSON file");
  add_input_arguments(*command, *arguments, true);
  command->add_option("-o,--output", arguments->out, "File, or - for stdout")
      ->capture_default_str();
  add_run_arguments(*command, *arguments);
  command->footer(
      "The file is held in memory. Several inputs must share one transform and reference "
      "system.\nExample:\n  oriel collect labelled.city.jsonl -o labelled.city.json");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
