#include "cli/batch/arena.h"
#include "cli/batch/batch_command.h"
#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/batch/inputs/neighbours.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/options/target_options.h"
#include "cli/output/change_report.h"
#include "cli/output/label_outputs.h"
#include "cli/output/series_output.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/option_values.h"
#include "oriel/generalise.h"
#include "oriel/rules.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// What --edge-min may be: from the file's own millimetres to the size of a storey.
constexpr double kLeastEdge_m = 0.001, kMostEdge_m = 10;

struct GeneraliseArguments : LabellingArguments {
  TargetArguments target;
  std::vector<std::string> series;
  std::string at;
  bool checks_series = false;
  std::string explain;
  std::string metrics;
};

/// Rows and blocks, if the profile asks for them at the scale.
std::shared_ptr<const CityGroups> groups_of(const GeneraliseArguments& arguments,
                                            const Targets& targets) {
  if (!arguments.neighbours || !targets.scale || targets.profiles.empty() ||
      !asks_for_groups(targets.profiles[0], *targets.scale))
    return nullptr;
  return std::make_shared<CityGroups>(*arguments.neighbours, targets.profiles[0], *targets.scale,
                                      shares_in_arena(arguments.jobs), arguments.kept.get());
}

/// Roads and parcels only concern buildings that become one.
void check_kept(const GeneraliseArguments& arguments, bool has_groups, Report& report) {
  if (!arguments.kept || has_groups) return;
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::R279;
  issue.sentence =
      "--keep-free has no effect: no building becomes part of a block, which needs --neighbours "
      "and a profile with 'buildings' for the scale";
  issue.place.file = arguments.keep_free.front();
  report.add(issue);
}

/// What the counts of features begin with, before the label.
constexpr const char* kRemoved = "removed ";
constexpr const char* kKept = "kept ";

class Generaliser final : public ProducingCommand {
 public:
  Generaliser(const GeneraliseArguments& arguments, const Targets& targets, const RuleBase& rules,
              BatchRunner& runner)
      : arguments_(arguments),
        targets_(targets),
        rules_(rules),
        runner_(runner),
        outputs_(arguments, rules),
        changes_(arguments.explain, arguments.metrics),
        groups_(groups_of(arguments, targets)) {
    if (groups_ && outputs_.gathers_any())
      throw CLI::ValidationError(
          "-o", "buildings that become one can be written as CityJSON, CityJSONSeq and CityGML");
  }

  void name_files(NamedFiles& files) const override {
    outputs_.name_files(files);
    changes_.name_files(files);
  }
  void begin(std::size_t input) override {
    if (input == 0 && arguments_.repeat > 1) counts_.clear();
    changes_.begin(!runner_.is_last_run());
    outputs_.begin(input, !runner_.is_last_run());
  }
  std::unique_ptr<ProductMaker> maker(std::size_t input, const Document& document,
                                      Timings& timings) const override {
    return std::make_unique<Maker>(*this, input, document, timings);
  }
  void take(const Document& document, Product product) override {
    outputs_.take(document, product);
    changes_.take(product);
  }
  void end(std::size_t /*input*/) override {
    runner_.timings().measure(Stage::write, [&] { outputs_.end(); });
  }
  void commit() override {
    outputs_.commit();
    if (outputs_.has_ended()) changes_.commit();
  }
  void reopen() override {
    changes_.begin(false);
    outputs_.reopen();
  }

  [[nodiscard]] PartPlaces places() const override {
    PartPlaces places = outputs_.places();
    changes_.add_places(places);
    return places;
  }
  [[nodiscard]] std::string recipe() const override {
    return fmt::format("generalise {} kept={} explain={} json={} metrics={} {}", targets_.recipe(),
                       arguments_.kept ? arguments_.kept->sha256() : "",
                       !arguments_.explain.empty(), arguments_.explain.ends_with(".jsonl"),
                       changes_.has_metrics(), outputs_.recipe());
  }
  [[nodiscard]] bool is_streaming() const override { return outputs_.is_streaming(); }
  [[nodiscard]] bool writes_files() const override {
    return outputs_.has_any() && !outputs_.writes_stdout();
  }
  std::map<std::string, int>* counts() override { return &counts_; }

  [[nodiscard]] bool has_groups() const { return groups_ != nullptr; }
  /// Features that are gone, by label.
  [[nodiscard]] std::map<std::string, int> removed() const { return counted(kRemoved); }
  [[nodiscard]] std::vector<Issue> take_issues() { return outputs_.take_issues(); }
  /// Of features that stay.
  [[nodiscard]] std::optional<Issue> lacking_columns() const { return outputs_.lacking_columns(); }
  [[nodiscard]] std::vector<Issue> untyped() const { return outputs_.untyped(counted(kKept)); }

 private:
  class Maker final : public ProductMaker {
   public:
    Maker(const Generaliser& of, std::size_t input, const Document& document, Timings& timings)
        : of_(of),
          document_(document),
          timings_(timings),
          options_(of.options_of(timings)),
          record_(of.outputs_.record(input, document)) {
      for (const std::size_t family : document.families) ++family_sizes_[family];
    }
    void add(std::size_t i, PipelineResult result) override {
      const Building& building = document_.buildings[i];
      auto drawn = generalise(document_, building, result, of_.rules_, of_.targets_, options_);
      const bool is_grouped = drawn.is_gone || drawn.leads_group;
      const bool stays_open = result.is_open() && !drawn.repaired && !is_grouped;
      if (!is_grouped && !stays_open && !result.is_done()) return;
      of_.report(drawn, stays_open ? open_ : product_);
      if (stays_open) return;
      if (!is_grouped) {
        const PipelineResult& line = drawn.repaired ? *drawn.repaired : result;
        of_.outputs_.make_features(building, line, product_);
        of_.outputs_.add_attributes(building, line, record_->output);
        count(drawn, line, product_);
      }
      auto& written = record_->output.buildings;
      const auto before = static_cast<std::ptrdiff_t>(written.size());
      oriel::add(std::move(drawn), record_->output);
      // Whether they overlap shows when all are there.
      if (!document_.families.empty() && family_sizes_[document_.families[i]] > 1)
        relatives_.buildings.insert(relatives_.buildings.end(), written.begin() + before,
                                    written.end());
      record_->take();
    }
    Product finish() override {
      // Buildings of which nothing was drawn are named first.
      for (Issue& issue : std::exchange(product_.issues, std::move(open_.issues)))
        product_.issues.push_back(std::move(issue));
      for (const OutputPart part : {OutputPart::changes, OutputPart::metrics})
        product_[part].insert(0, open_[part]);
      timings_.measure(Stage::write, [&] {
        relatives_.options.gone = record_->output.options.gone;
        std::ranges::move(overlaps_as_written(document_, relatives_),
                          std::back_inserter(product_.issues));
        OutputSink::finish(record_, product_);
      });
      return std::move(product_);
    }

   private:
    const Generaliser& of_;
    const Document& document_;
    Timings& timings_;
    GeneraliseOptions options_;
    std::shared_ptr<RecordText> record_;
    std::unordered_map<std::size_t, std::size_t> family_sizes_;
    OutputRecord relatives_;  ///< the geometries of families of several
    Product product_, open_;
  };

  [[nodiscard]] GeneraliseOptions options_of(Timings& timings) const {
    GeneraliseOptions options;
    static_cast<LabelOptions&>(options) = arguments_.label_options(timings.observer());
    options.reports_changes = !arguments_.explain.empty();
    options.reports_figures = changes_.has_metrics();
    options.groups = groups_;
    return options;
  }

  void report(const GeneralisedBuilding& drawn, Product& product) const {
    product.issues.insert(product.issues.end(), drawn.issues.begin(), drawn.issues.end());
    for (const TargetReport& report : drawn.reports) {
      product[OutputPart::changes] += changes_.text(drawn.building, report.target, report.changes);
      if (report.figures)
        product[OutputPart::metrics] +=
            changes_.text(drawn.building, report.target, *report.figures);
    }
  }

  /// Of several levels of detail the first says what is gone from the building.
  static void count(const GeneralisedBuilding& drawn, const PipelineResult& from,
                    Product& product) {
    if (drawn.levels.empty()) return;
    for (const auto& [label, count] : count_labels(from.interpretation))
      product.counts[kKept + label] += count;
    for (const auto& [label, count] : drawn.levels[0].removed) {
      product.counts[kKept + label] -= count;
      product.counts[kRemoved + label] += count;
    }
  }

  /// The counts whose names begin with `what`, by what follows.
  [[nodiscard]] std::map<std::string, int> counted(const std::string& what) const {
    std::map<std::string, int> found;
    for (const auto& [name, count] : counts_)
      if (name.starts_with(what)) found[name.substr(what.size())] = count;
    return found;
  }

  const GeneraliseArguments& arguments_;
  const Targets& targets_;
  const RuleBase& rules_;
  BatchRunner& runner_;
  LabelOutputs outputs_;
  ChangeReport changes_;
  std::shared_ptr<const CityGroups> groups_;
  /// Features that are gone and those that stay, by label.
  std::map<std::string, int> counts_;
};

/// The profile of a series; nothing if it cannot be used, which is told.
std::optional<ExitCode> make_series(const GeneraliseArguments& arguments, const RuleBase& rules,
                                    Report& report) {
  if (arguments.series.empty()) return std::nullopt;
  if (!arguments.explain.empty() || !arguments.metrics.empty())
    refuse_usage("--series", Code::G414,
                 "does not work with --explain and --metrics, which are for one scale");
  const std::vector<double> scales = scales_of(arguments.series, "--series");
  if (arguments.target.profile.empty()) check_kept(arguments, false, report);
  if (arguments.target.profile.empty())
    return write_series(arguments, scales, std::nullopt, rules, report);
  const auto profile = load_profile_file(arguments.target.profile);
  check_level("--profile", profile.issues);
  report.add(profile.issues);
  if (!profile.value) return ExitCode::rules;
  const auto unfit =
      check_profile(*profile.value, rules, ProfileUse::series, arguments.neighbours != nullptr);
  report.add(unfit);
  if (has_errors(unfit)) return ExitCode::rules;
  check_kept(arguments, arguments.neighbours && asks_for_groups(*profile.value, scales.back()),
             report);
  return write_series(arguments, scales, profile.value, rules, report);
}

/// With --at or --check the option --from names a series, else the format of the inputs.
void check_source(const GeneraliseArguments& arguments) {
  if (!arguments.at.empty() || arguments.checks_series) {
    const std::string option = arguments.checks_series ? "--check" : "--at";
    if (!arguments.inputs.empty())
      throw CLI::ValidationError(option, "takes no input but the series that --from names");
    if (arguments.from.empty())
      throw CLI::ValidationError(option, "needs --from NAME, the -o of the --series that was made");
    if (!arguments.selection.is_all())
      throw CLI::ValidationError(
          option, "takes the whole level, without --id, --bbox, --cotype, --random and --exclude");
    if (arguments.checks_series && !arguments.out.empty())
      throw CLI::ValidationError(option, "writes nothing, so it takes no -o");
    return;
  }
  if (arguments.inputs.empty()) throw CLI::RequiredError("input");
  const std::string wrong = input_formats()(arguments.from);
  if (!arguments.from.empty() && !wrong.empty()) throw CLI::ValidationError("--from", wrong);
}

ExitCode work(GeneraliseArguments& arguments) {
  arguments.only_names_surfaces = true;
  if (arguments.checks_series) {
    check_source(arguments);
    Report report(arguments.is_verbose);
    return check_stored_series(arguments.from, report);
  }
  if (arguments.out.empty()) {
    if (!arguments.is_piped_stream() || !arguments.series.empty())
      throw CLI::RequiredError("--output");
    arguments.out = "-";
  }
  check_source(arguments);
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  if (!arguments.at.empty())
    return write_level_at(arguments.from, denominator_of(arguments.at, "--at"), arguments.out,
                          report);
  const auto rules = load_rules(arguments, report);
  if (!rules) return ExitCode::rules;
  find_neighbours(arguments, report, arguments.out);
  find_kept_ground(arguments);
  if (const auto code = make_series(arguments, *rules, report)) return *code;
  const auto targets =
      targets_of(arguments.target, *rules, arguments.neighbours != nullptr, report);
  if (!targets) return ExitCode::rules;
  if (std::ranges::any_of(targets->profiles, &Profile::names_classes))
    arguments.stl_solids = StlSolids::by_class;
  BatchRunner runner(arguments, &*rules, report);
  Generaliser command(arguments, *targets, *rules, runner);
  check_kept(arguments, command.has_groups(), report);
  const ExitCode code = runner.run(command);
  if (runner.was_done()) return code;
  if (const auto lacking = command.lacking_columns()) report.add(*lacking);
  report.add(command.take_issues());
  report.add(command.untyped());
  runner.report_summary("generalised to " + targets->text(), command.removed(), " left out");
  return code;
}

}  // namespace

void add_generalise(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<GeneraliseArguments>();
  CLI::App* command = app.add_subcommand(
      "generalise", "Redraw buildings for a target scale or level of detail, as closed solids");
  add_label_arguments(*command, *arguments);
  command->get_option("input")->required(false);
  CLI::Option* from = command->get_option("--from");
  from->get_validator(0)->active(false);
  from->description(from->get_description() + "; with --at or --check, the NAME of a series");
  CLI::Option_group* target = command->add_option_group("Target");
  const CLI::Option* scale =
      target->add_option("--scale", arguments->target.scale, "Target scale, such as 1:2000");
  target
      ->add_option("--to-lod", arguments->target.lods,
                   "Levels of detail to make, such as 2.0,1.2, all in one file")
      ->allow_extra_args(false)
      ->delimiter(',');
  target
      ->add_option(
          "--series", arguments->series,
          "Target scales, such as 1:500,1:2000: writes one file each, NAME.1-2000.city.json, and "
          "the log of all operations, NAME.oplog.jsonl; -o gives NAME")
      ->allow_extra_args(false)
      ->delimiter(',');
  target->add_option(
      "--at", arguments->at,
      "Write the level at this scale from the stored series --from NAME; takes no input");
  target->add_flag("--check", arguments->checks_series,
                   "Prove the stored series --from NAME: log and levels are what was written, and "
                   "the operations lead from each level to the next and back");
  target->require_option(0, 1);
  command->add_option("--explain", arguments->explain,
                      "Write what was done to each feature, by which entry, and what was refused "
                      "and why: text, or JSON lines if the name ends in .jsonl");
  command->add_option("--metrics", arguments->metrics,
                      "Write figures before and after, one JSON line per building and target");
  command
      ->add_option("--keep-free", arguments->keep_free,
                   "GeoJSON or CityJSON with roads and parcels, in the reference system of the "
                   "buildings: no block of buildings that become one covers them (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_option("--profile", arguments->target.profile,
                      "What to do with features that the pack has no entry for: NAME[:LEVEL] or a "
                      "file (default with --to-lod: lod; with --scale: they stay). Without a "
                      "target, the profile's level is made");
  command
      ->add_option("--edge-min", arguments->target.edge_min_m,
                   "Least length of an edge and width of a gap, in m, instead of the profile's")
      ->check(number_in(kLeastEdge_m, kMostEdge_m));
  command->footer(
      "Example:\n  oriel generalise house.city.json --scale 1:20000 -o house-1-20000.city.json");
  command->callback([arguments, &action, target, scale] {
    if (target->count_all() == 0 && arguments->target.profile.empty())
      throw CLI::RequiredError("[--scale,--to-lod,--series,--at,--check]");
    arguments->target.has_scale = scale->count() > 0;
    action = [arguments] { return work(*arguments); };
  });
}

}  // namespace oriel::cli
