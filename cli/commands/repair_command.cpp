#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/output/output_sink.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/option_values.h"
#include "io/files/output_file.h"
#include "io/records/stage_json.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "oriel/repair.h"

#include <map>
#include <memory>
#include <ranges>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct RepairArguments : RunOptions {
  std::string out;
  std::string to;
  std::string report;
};

/// What was done to a building, in words.
std::string summary_of(const Building& building, const Repaired& repaired) {
  const RepairReport& report = repaired.report;
  if (!report.was_needed)
    return fmt::format("{}: {}", building.id,
                       repaired.solid ? "closed already" : "could not be repaired");
  if (!repaired.solid)
    return fmt::format("{}: stays open, {}", building.id,
                       counted(report.open_edges.size(), "open edge"));
  double closed_m2 = 0;
  for (const Cap& cap : report.caps) closed_m2 += cap.area_m2;
  return fmt::format(
      "{}: repaired: {} dropped, {} inserted into edges, {} cut at contacts, {} of more than two "
      "polygons, {} turned round, {} ({:.2f} m2) and {} ({:.2f} m2) left out, {} closed "
      "({:.2f} m2), {}, {}",
      building.id, counted(report.duplicates.size(), "duplicate"),
      counted(report.t_vertices, "vertex", "vertices"), counted(report.cut, "polygon"),
      counted(report.crowded_edges, "edge"), counted(report.turned, "polygon"),
      counted(report.dangling.size(), "dangling sheet"), report.dangling_area_m2,
      counted(report.inner.size(), "inner face"), report.inner_area_m2,
      counted(report.caps.size(), "hole"), closed_m2,
      counted(report.detached_shells, "detached shell"),
      counted(report.cavities, "cavity", "cavities"));
}

/// The counts of buildings that became solids.
constexpr const char* kRepaired = "repaired";
constexpr const char* kClosed = "closed";

class Repairer final : public ProducingCommand {
 public:
  Repairer(const RepairArguments& arguments, BatchRunner& runner)
      : arguments_(arguments),
        runner_(runner),
        sink_(arguments.out, arguments.to, arguments.inputs, arguments.read_options().format) {}

  void name_files(NamedFiles& files) const override {
    sink_.name_files(files, !arguments_.selection.is_all());
    files.add_output("--report", arguments_.report);
  }
  void begin(std::size_t input) override {
    sink_.begin(input, !runner_.is_last_run());
    if (runner_.is_last_run() && !report_ && !arguments_.report.empty())
      report_ = std::make_unique<OutputFile>(arguments_.report);
  }
  std::unique_ptr<ProductMaker> maker(std::size_t input, const Document& document,
                                      Timings& timings) const override {
    return std::make_unique<Maker>(*this, input, document, timings);
  }
  [[nodiscard]] bool needs_polygons() const override { return sink_.gathers_any(); }
  void take(const Document& document, Product product) override {
    sink_.take(document, product);
    if (!runner_.is_last_run()) return;
    if (report_) report_->append(product[OutputPart::changes]);
    std::istringstream lines(product[OutputPart::listing]);
    for (std::string line; std::getline(lines, line);) run_log().write(LogLevel::info, line);
  }
  void end(std::size_t /*input*/) override {
    has_ended_ = true;
    runner_.timings().measure(Stage::write, [&] { sink_.end(); });
  }
  void commit() override {
    if (report_ && has_ended_) report_->commit();
  }
  std::map<std::string, int>* counts() override {
    return runner_.is_last_run() ? &counts_ : nullptr;
  }

  [[nodiscard]] std::vector<Issue> take_issues() { return sink_.take_issues(); }
  [[nodiscard]] std::string summary() {
    return fmt::format("closed ({} repaired, {} found closed)", counts_[kRepaired],
                       counts_[kClosed]);
  }

 private:
  class Maker final : public ProductMaker {
   public:
    Maker(const Repairer& of, std::size_t input, const Document& document, Timings& timings)
        : of_(of),
          document_(document),
          timings_(timings),
          record_(of.sink_.record(input, document)) {}
    void add(std::size_t i, PipelineResult result) override {
      timings_.measure(Stage::write, [&] { add(document_.buildings[i], std::move(result)); });
    }
    Product finish() override {
      timings_.measure(Stage::write, [&] { OutputSink::finish(record_, product_); });
      return std::move(product_);
    }

   private:
    void add(const Building& building, PipelineResult result) {
      const std::size_t reported = result.issues.size();
      Repaired one = repair(document_, building, std::move(result),
                            of_.arguments_.label_options(timings_.observer()));
      for (const Issue& issue : one.issues | std::views::drop(reported))
        if (issue.severity == Severity::error) product_.issues.push_back(issue);
      if (one.solid) ++product_.counts[one.report.was_needed ? kRepaired : kClosed];
      if (of_.arguments_.is_verbose)
        product_[OutputPart::listing] += printable(summary_of(building, one)) + '\n';
      if (!of_.arguments_.report.empty())
        product_[OutputPart::changes] +=
            repair_json(building, one.solid.has_value(), one.report, one.issues);
      if (one.solid) record_->output.buildings.push_back(std::move(one.output));
      record_->take();
    }

    const Repairer& of_;
    const Document& document_;
    Timings& timings_;
    std::shared_ptr<RecordText> record_;
    Product product_;
  };

  const RepairArguments& arguments_;
  BatchRunner& runner_;
  OutputSink sink_;
  std::unique_ptr<OutputFile> report_;
  bool has_ended_ = false;  ///< an input did
  std::map<std::string, int> counts_;
};

ExitCode work(RepairArguments& arguments) {
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  BatchRunner runner(arguments, nullptr, report);
  Repairer command(arguments, runner);
  const ExitCode code = runner.run(command);
  report.add(command.take_issues());
  runner.report_summary(command.summary(), {});
  return code;
}

}  // namespace

void add_repair(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<RepairArguments>();
  arguments->ends_at_solid = true;
  arguments->crossings = "cut";
  CLI::App* command = app.add_subcommand(
      "repair", "Turn buildings into valid solids: closed, oriented, with planar faces");
  add_input_arguments(*command, *arguments, true);
  command
      ->add_option("-o,--output", arguments->out,
                   "File, - for stdout, or a folder (ending in /) for several inputs")
      ->required();
  command
      ->add_option("--to", arguments->to, "Format to write (default: from the name of the output)")
      ->check(one_of({"cityjson", "cityjsonseq", "citygml2", "citygml3", "gpkg", "obj", "off",
                      "ply", "stl", "glb"}));
  command->add_flag("--ignore-semantics", arguments->ignores_semantics,
                    "Write the solids without the semantics of the input");
  command->add_option("--report", arguments->report,
                      "Write a report of the repairs: one JSON object per line and building");
  add_solid_arguments(*command, *arguments);
  add_run_arguments(*command, *arguments);
  add_force_argument(*command, *arguments);
  command->footer(
      "Buildings that stay open are written unchanged, and the exit code is 3.\n"
      "Example:\n  oriel repair house.city.json -o repaired.city.json\n"
      "  oriel repair city/*.city.json -o repaired/ --close any --report repairs.jsonl");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
