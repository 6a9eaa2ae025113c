#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/streams/stream_lines.h"
#include "io/files/output_file.h"

#include <memory>

#include <CLI/CLI.hpp>

namespace oriel::cli {

namespace {

struct CatArguments : RunOptions {
  std::string out = "-";
};

/// One stream of all inputs, under the header of the first.
class Cat final : public VisitingCommand {
 public:
  Cat(const CatArguments& arguments, BatchRunner& runner)
      : arguments_(arguments),
        runner_(runner),
        lines_({[&](const std::string& line) { add_header(line); },
                [&](const std::string& line) { append(line); }},
               arguments.selection) {}

  void name_files(NamedFiles& files) const override { files.add_output("-o", arguments_.out); }
  [[nodiscard]] std::size_t other_features() const override { return lines_.features(); }
  void begin(std::size_t input) override {
    lines_.begin();
    input_ = input;
    if (input == 0) has_header_ = false;
    if (!out_ && runner_.is_last_run()) out_ = std::make_unique<OutputFile>(arguments_.out);
  }
  void visit(const Document& document, std::vector<PipelineResult>& results) override {
    runner_.timings().measure(Stage::write, [&] { lines_.add(document, results); });
  }
  void end(std::size_t /*input*/) override { has_ended_ = true; }
  void commit() override {
    if (out_ && has_ended_) out_->commit();
  }

 private:
  void add_header(const std::string& line) {
    if (const auto issue = header_.check(line, arguments_.inputs[input_])) throw InputError(*issue);
    if (!has_header_) append(line);
    has_header_ = true;
  }
  void append(const std::string& line) {
    if (out_) out_->append(line);
  }

  const CatArguments& arguments_;
  BatchRunner& runner_;
  StreamLines lines_;
  CommonHeader header_;
  std::unique_ptr<OutputFile> out_;  ///< of the last run
  std::size_t input_ = 0;
  bool has_header_ = false;
  bool has_ended_ = false;  ///< an input did
};

ExitCode work(CatArguments& arguments) {
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  BatchRunner runner(arguments, nullptr, report);
  Cat command(arguments, runner);
  check_output_format(arguments, command, arguments.out, Format::cityjson_seq);
  const ExitCode code = runner.run(command);
  runner.report_summary("passed on", {});
  return code;
}

}  // namespace

void add_cat(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<CatArguments>();
  arguments->ends_at_reading = true;
  CLI::App* command = app.add_subcommand(
      "cat", "Write buildings as a stream (CityJSONSeq): a header, then one line per feature");
  add_input_arguments(*command, *arguments, true);
  command->add_option("-o,--output", arguments->out, "File, or - for stdout")
      ->capture_default_str();
  add_run_arguments(*command, *arguments);
  command->footer(
      "Several inputs become one stream if they share one transform and reference "
      "system.\nExample:\n  oriel cat city.city.json | oriel label - | oriel generalise - --scale "
      "1:5000 | oriel collect - -o out.city.json");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
