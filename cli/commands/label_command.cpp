#include "cli/batch/batch_command.h"
#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/batch/inputs/neighbours.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/output/energy_tables.h"
#include "cli/output/label_outputs.h"
#include "cli/terminal/option_values.h"
#include "cli/terminal/print_out.h"
#include "cli/terminal/table.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "oriel/energy.h"
#include "oriel/explain.h"
#include "oriel/repair.h"
#include "oriel/score.h"

#include <map>
#include <optional>
#include <set>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct LabelArguments : LabellingArguments {
  EnergyArguments energy;
  std::string corrections_file;
  std::string existing = "fill";
  bool is_json = false;
  bool is_repaired = false;

  [[nodiscard]] WriteOptions write_options() const {
    WriteOptions options;
    if (existing == "keep") options.existing = ExistingSemantics::keep;
    if (existing == "replace") options.existing = ExistingSemantics::replace;
    return options;
  }
};

/// The labelled features of a building for a reader at a terminal.
std::string listing(const Building& building, const PipelineResult& line) {
  const FeatureTable& of = line.description.table;
  std::vector<std::vector<std::string>> rows{
      {"feature", "label", "score", "margin", "rule", "a m", "b m", "base height m", "name"}};
  const std::vector<std::string> names = names_of_features(line);
  const auto number = [&](FeatureId id, Attribute attribute) {
    const auto value = of.number(id, attribute);
    return value ? fmt::format("{:.2f}", *value) : std::string("-");
  };
  for (const Verdict& verdict : line.interpretation.verdicts) {
    if (verdict.label.empty()) continue;
    rows.push_back({of.id(verdict.feature), verdict.label, fmt::format("{:.2f}", verdict.score),
                    fmt::format("{:.2f}", verdict.margin), verdict.rule,
                    number(verdict.feature, Attribute::a), number(verdict.feature, Attribute::b),
                    number(verdict.feature, Attribute::base_height),
                    names[verdict.feature.index()]});
  }
  const std::size_t labelled = rows.size() - 1, all = line.interpretation.verdicts.size();
  return fmt::format("{}: {} {} a label\n{}\n", printable(building.id),
                     counted_of(labelled, all, "feature"),
                     agreeing_of(labelled, all, "has", "have"), table(rows));
}

/// --repaired: the labels on the facets of the building's solid. Without one that is valid they
/// stay on the polygons, and the building counts as set aside.
void put_on_solid(const Document& document, const Building& building, const PipelineResult& line,
                  LabelledBuilding& labelled, std::vector<Issue>& issues) {
  auto drawn = on_solid(document, building, line, labelled);
  issues.insert(issues.end(), drawn.issues.begin(), drawn.issues.end());
  if (drawn.value) labelled = std::move(*drawn.value);
}

/// OBJ has groups and materials, which are no semantics.
bool has_semantics(Format format) {
  return format == Format::cityjson || format == Format::cityjson_seq || format == Format::citygml;
}

/// Says where the input's semantics and the rules disagree; nothing is written.
ExitCode audit(const LabelArguments& arguments) {
  if (!arguments.out.empty() || !arguments.features.empty() || arguments.energy.has_any())
    throw CLI::ValidationError("--existing",
                               "audit changes nothing: leave out -o, --features and --table");
  Report report(arguments.is_verbose);
  const auto rules = load_rules(arguments, report);
  if (!rules) return ExitCode::rules;
  BatchRunner runner(arguments, &*rules, report);
  SurfaceScore score;
  RecordVisitor visitor([&](const Document& document, std::vector<PipelineResult>& lines) {
    if (!runner.is_last_run() || !has_semantics(document.format)) return;
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (lines[i].has_surfaces())
        compare_surfaces(document.buildings[i], lines[i], *rules, arguments.label_options(),
                         OpeningPolicy::compare, score);
  });
  ExitCode code = runner.run(visitor);
  if (const auto issue = no_names(score, runner.state().buildings)) {
    report.add(*issue);
    code = graver(code, ExitCode::set_aside);
  }
  const std::string text =
      arguments.is_json ? to_json(score, true) + "\n" : differences_text(score) + to_text(score);
  print_out(text, arguments.is_json);
  runner.report_summary("audited", {});
  return graver(code, score.differences.empty() ? ExitCode::clean : ExitCode::set_aside);
}

/// The count of buildings that came to the end without a body to measure.
constexpr const char* kUnmeasured = "unmeasured";

class Labeller final : public ProducingCommand {
 public:
  Labeller(const LabelArguments& arguments, const RuleBase& rules, BatchRunner& runner)
      : arguments_(arguments),
        rules_(rules),
        runner_(runner),
        outputs_(arguments, rules),
        tables_(arguments.energy, arguments.has_safe_cells) {
    if (!arguments.energy.extension.empty() && !outputs_.writes_cityjson())
      throw CLI::ValidationError("--extension",
                                 "needs an output that is CityJSON or CityJSONSeq, made of such an "
                                 "input: -o X.city.json, X.city.jsonl");
    if (tables_.takes_stdout() && arguments.out == "-")
      throw CLI::ValidationError("--table", "stdout takes the buildings (-o -): write NAME=FILE");
    if (tables_.has_any() && !tables_.is_of_lines() && !arguments.reuse.empty())
      throw CLI::ValidationError("--reuse", "needs tables that are files in .csv or .jsonl");
  }

  void name_files(NamedFiles& files) const override {
    outputs_.name_files(files);
    tables_.name_files(files);
    if (!arguments_.corrections_file.empty())
      files.add_input("--corrections", arguments_.corrections_file);
  }
  void begin(std::size_t input) override {
    outputs_.begin(input, !runner_.is_last_run());
    tables_.begin(!runner_.is_last_run());
  }
  std::unique_ptr<ProductMaker> maker(std::size_t input, const Document& document,
                                      Timings& timings) const override {
    return std::make_unique<Maker>(*this, input, document, timings);
  }
  [[nodiscard]] bool needs_polygons() const override { return outputs_.gathers_any(); }
  void take(const Document& document, Product product) override {
    if (!runner_.is_last_run()) product[OutputPart::listing].clear();
    if (arguments_.corrections)
      for (const Building& building : document.buildings) buildings_.insert(building.id);
    outputs_.take(document, product);
    tables_.take(product);
  }
  void end(std::size_t /*input*/) override {
    runner_.timings().measure(Stage::write, [&] { outputs_.end(); });
  }
  void commit() override {
    outputs_.commit();
    if (outputs_.has_ended()) tables_.commit();
  }
  void reopen() override {
    outputs_.reopen();
    tables_.begin(false);
  }

  [[nodiscard]] PartPlaces places() const override {
    PartPlaces places = outputs_.places();
    tables_.add_places(places);
    return places;
  }
  [[nodiscard]] std::string recipe() const override {
    return fmt::format("label existing={} repaired={} {}{}{}", arguments_.existing,
                       arguments_.is_repaired, outputs_.recipe(), tables_.recipe(),
                       arguments_.energy.extension);
  }
  [[nodiscard]] bool is_streaming() const override { return outputs_.is_streaming(); }
  [[nodiscard]] bool writes_files() const override {
    return (outputs_.has_any() || tables_.has_any()) && !outputs_.writes_stdout() &&
           !tables_.takes_stdout();
  }

  [[nodiscard]] std::vector<Issue> take_issues() { return outputs_.take_issues(); }
  [[nodiscard]] std::optional<Issue> lacking_columns() const { return outputs_.lacking_columns(); }

  /// The buildings that were read.
  [[nodiscard]] const std::set<std::string>& buildings() const { return buildings_; }

  std::map<std::string, int>* counts() override {
    return runner_.is_last_run() ? &counts_ : nullptr;
  }

  /// Of --table and --extension.
  [[nodiscard]] std::optional<Issue> unmeasured() const {
    const auto found = counts_.find(kUnmeasured);
    if (found == counts_.end()) return std::nullopt;
    return nothing_measured(found->second);
  }

  /// Of all that was labelled.
  [[nodiscard]] std::vector<Issue> untyped() const {
    return outputs_.untyped(runner_.state().labels);
  }

 private:
  class Maker final : public ProductMaker {
   public:
    Maker(const Labeller& of, std::size_t input, const Document& document, Timings& timings)
        : of_(of),
          document_(document),
          timings_(timings),
          record_(of.outputs_.record(input, document, of.arguments_.write_options())) {
      if (of.arguments_.energy.has_any()) storeys_ = stated_storeys(document);
    }
    void add(std::size_t i, PipelineResult result) override {
      timings_.measure(Stage::write, [&] { add(document_.buildings[i], i, result); });
    }
    Product finish() override {
      timings_.measure(Stage::write, [&] {
        if (record_) OutputSink::finish(record_, product_);
        if (of_.arguments_.energy.extension.empty()) return;
        product_.flatten();
        if (std::string& text = product_[OutputPart::buildings]; !text.empty())
          text = with_energy_extension(text, energy_);
      });
      return std::move(product_);
    }

   private:
    void add(const Building& building, std::size_t i, const PipelineResult& result) {
      const LabelOutputs& outputs = of_.outputs_;
      if (of_.arguments_.energy.has_any() && !result.is_passed_over)
        measure_energy(building, i, result);
      if (record_ && result.has_surfaces()) {
        LabelledBuilding& labelled =
            record_->output.buildings.emplace_back(outputs.annotated(building, result));
        if (of_.arguments_.is_repaired && result.is_done())
          put_on_solid(document_, building, result, labelled, product_.issues);
        record_->take();
      }
      if (!result.is_done()) return;
      outputs.make_features(building, result, product_);
      if (record_) outputs.add_attributes(building, result, record_->output);
      if (!outputs.has_any() && !of_.tables_.has_any())
        product_[OutputPart::listing] += listing(building, result);
    }

    void measure_energy(const Building& building, std::size_t i, const PipelineResult& result) {
      energy_.push_back(of_.tables_.energy(building, result, of_.rules_,
                                           of_.arguments_.label_options(), storeys_[i]));
      of_.tables_.make(energy_.back(), product_);
      if (result.is_done() && !energy_.back().is_known) ++product_.counts[kUnmeasured];
      if (of_.arguments_.energy.extension.empty()) energy_.clear();
    }

    const Labeller& of_;
    const Document& document_;
    Timings& timings_;
    std::vector<std::optional<int>> storeys_;
    std::vector<BuildingEnergy> energy_;  ///< for the extension
    std::shared_ptr<RecordText> record_;  ///< null: no buildings are written
    Product product_;
  };

  const LabelArguments& arguments_;
  const RuleBase& rules_;
  BatchRunner& runner_;
  LabelOutputs outputs_;
  EnergyTables tables_;
  /// kUnmeasured.
  std::map<std::string, int> counts_;
  /// With corrections.
  std::set<std::string> buildings_;
};

ExitCode work(LabelArguments& arguments) {
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  if (arguments.existing == "audit") return audit(arguments);
  if (arguments.is_piped_stream() && arguments.out.empty() && arguments.features.empty() &&
      !arguments.energy.has_any())
    arguments.out = "-";
  if (arguments.is_repaired) arguments.crossings = "cut";
  arguments.joins_installations = !arguments.is_repaired;
  arguments.only_names_surfaces = true;
  // The listing has attributes, which measuring envelopes does not ask for.
  const bool has_listing = arguments.out.empty() && arguments.energy.tables.empty();
  arguments.only_labels_features = !has_listing && arguments.features.empty() &&
                                   !arguments.has_reasons && !arguments.is_repaired &&
                                   !arguments.writes_attributes();
  if (arguments.is_json) throw CLI::ValidationError("--json", "works only with --existing audit");
  const auto rules = load_rules(arguments, report);
  if (!rules) return ExitCode::rules;
  check_unheated(arguments.energy, *rules);
  arguments.seeks_features = rules->rule_count() > 0;
  arguments.gives_only_features = arguments.out.empty() && arguments.energy.tables.empty();
  ExitCode code = ExitCode::clean;
  arguments.corrections = load_corrections(arguments.corrections_file, *rules, report, code);
  find_neighbours(arguments, report, arguments.out);
  BatchRunner runner(arguments, &*rules, report);
  Labeller command(arguments, *rules, runner);
  code = graver(code, runner.run(command));
  if (runner.was_done()) return code;
  if (const auto lacking = command.lacking_columns()) report.add(*lacking);
  if (const auto unmeasured = command.unmeasured()) report.add(*unmeasured);
  // A run that goes on, or takes results, has not seen all buildings.
  if (arguments.corrections && !arguments.is_resumable && arguments.reuse.empty()) {
    const auto unknown = arguments.corrections->unknown_buildings(command.buildings());
    report.add(unknown);
    if (!unknown.empty()) code = graver(code, ExitCode::set_aside);
  }
  report.add(command.take_issues());
  report.add(command.untyped());
  runner.report_summary("labelled", runner.state().labels);
  return code;
}

}  // namespace

void add_label(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<LabelArguments>();
  CLI::App* command = app.add_subcommand(
      "label", "Label the parts of buildings by rules and write the buildings with their labels");
  add_label_arguments(*command, *arguments);
  add_energy_arguments(*command, arguments->energy);
  command
      ->add_option("--existing", arguments->existing,
                   "Semantics that the input has: fill adds what is missing; keep does so and "
                   "changes nothing else; replace overwrites them; audit only reports where the "
                   "rules disagree")
      ->check(one_of({"fill", "keep", "replace", "audit"}))
      ->capture_default_str();
  command->add_flag("--ignore-semantics", arguments->ignores_semantics,
                    "Ignore what the input calls its polygons when looking for parts");
  command->add_flag("--repaired", arguments->is_repaired,
                    "Write the valid solid of each building, as repair makes it, with its labels");
  add_corrections_argument(*command, arguments->corrections_file);
  command->add_flag("--explain", arguments->has_reasons,
                    "Write the reason for every label and surface into the file, as oriel_why");
  command->add_flag("--json", arguments->is_json, "With --existing audit: as JSON");
  command->footer(
      "Without -o, --features and --table, the labels are listed; a stream from stdin goes to "
      "stdout. "
      "Polygons are written unchanged unless --repaired is given.\nExample:\n  oriel label "
      "house.city.json -o labelled.city.json\n  oriel label city/*.city.json -o labelled/ "
      "--features parts.csv --rules my_rules.yaml");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
